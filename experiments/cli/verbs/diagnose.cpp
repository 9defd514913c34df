#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/temporary_path.hpp>
#include <gyrostat/diagnosis/answer.hpp>
#include <gyrostat/diagnosis/diagnosis_json.hpp>
#include <gyrostat/diagnosis/diagnosis_tables.hpp>
#include <gyrostat/experiments/cli/diagnosed.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/simulated.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/cli/watched.hpp>
#include <gyrostat/experiments/findings/diagnosis_page.hpp>
#include <gyrostat/experiments/findings/diagnosis_pictures.hpp>
#include <gyrostat/experiments/findings/fleet_page.hpp>
#include <gyrostat/experiments/findings/member_tables.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* diagnose_examples = R"(Examples:
  gyrostat diagnose REC.csv                          every axis that it has, and what they share
  gyrostat diagnose REC.csv --html GAP.html --json GAP.json     of several axes, a page each, too
  gyrostat diagnose REC.csv --out-figures FIGURES    every picture as SVG
  gyrostat diagnose REC.csv --scenario STUDY.json    a study whose simulator has the effect
  gyrostat diagnose REC.csv --axis z                 one of its axes
  gyrostat diagnose A.csv B.csv C.csv                every sensor of a fleet, likewise
  gyrostat diagnose OTHER.csv --claim STUDY.json     does it close the gap of another recording?
  gyrostat diagnose REC.csv --simulated SIM.csv --out-simulated MENDED
  gyrostat diagnose TODAY.csv --baseline STUDY.json --fail-if 'gap>2'    5 where it holds
  gyrostat diagnose logs/*.csv --fail-if 'vibration>0.9' --jsonl         a line of JSON each)";

struct DiagnoseArguments {
  RecordingOption recording;
  SpanOption span;
  FormatOption format;
  std::string json_out, html_out, scenario_out, figures_out, claim;
  bool timing = false, fleet = false;
  gap::DiagnosisOptions options;
  SimulatedArguments simulated;
  WatchArguments watch;
};

using Given = std::vector<std::pair<const char*, bool>>;

void refuse(const Given& options, const std::string& why) {
  for (const auto& [option, is_given] : options)
    if (is_given) throw InputError(option, why);
}

/// What is written of each diagnosis.
Given of_each(const DiagnoseArguments& arguments) {
  return {{"--html", !arguments.html_out.empty()},
          {"--scenario", !arguments.scenario_out.empty()},
          {"--out-figures", !arguments.figures_out.empty()}};
}

bool any(const Given& options) {
  return std::any_of(options.begin(), options.end(), [](const auto& o) { return o.second; });
}

int run_simulated(const DiagnoseArguments& arguments, Format format, Console& console) {
  refuse({{"--scenario", !arguments.scenario_out.empty()},
          {"--out-figures", !arguments.figures_out.empty()},
          {"--claim", !arguments.claim.empty()}},
         "is of gyrostat's own simulator; beside --simulated there are --html, --json and "
         "--out-simulated");
  refuse({{"--fail-if", !arguments.watch.fail_if.empty()},
          {"--baseline", !arguments.watch.baseline.empty()},
          {"--jsonl", arguments.watch.json_lines}},
         "is of recordings alone, without --simulated");
  auto traces = arguments.simulated;
  traces.json_out = arguments.json_out;
  traces.html_out = arguments.html_out;
  return diagnose_simulated(traces, arguments.recording, arguments.span,
                            {.seed = arguments.options.seed, .without = arguments.options.without},
                            format, console);
}

/// The simulator that is judged in place of looking for causes.
void give_claim(DiagnoseArguments& arguments) {
  if (!arguments.claim.empty() && !arguments.watch.baseline.empty())
    throw InputError("--baseline", "stands in place of --claim; give one of them");
  if (!arguments.claim.empty()) {
    const auto study = read_study(arguments.claim);
    if (study.cells.front().scenario.effects.empty())
      throw InputError(arguments.claim, "its scenario has no effects; there is nothing to judge");
    arguments.options.claim = study.cells.front().scenario;
  }
  arguments.watch.give_baseline(arguments.options);
}

/// The study whose simulator has the effects, under the recording's conditions where these matter.
nlohmann::ordered_json enriched_study(const DiagnoseArguments& arguments, const ToDiagnose& of,
                                      const gap::Diagnosis& diagnosis, const std::string& name,
                                      const fs::path& out) {
  auto study = gap::scenario_json(diagnosis, name);
  if (of.recording.file == "-" || !gap::depends_on_conditions(diagnosis)) return study;
  auto source = of.recording.source_for(fs::absolute(out).parent_path());
  if (arguments.span.from_s > 0.0) source["from_s"] = arguments.span.from_s;
  if (arguments.span.to_s < SpanOption{}.to_s) source["to_s"] = arguments.span.to_s;
  study["cells"][0]["scenario"]["conditions_from"] = std::move(source);
  return study;
}

/// All but the JSON; `suffix` tells the files of several apart.
void write_one(const DiagnoseArguments& arguments, const ToDiagnose& of,
               const gap::Diagnosis& diagnosis, const std::string& name,
               const std::string& suffix = {}) {
  const auto told_apart = [&](const fs::path& path) {
    return path.parent_path() / (path.stem().string() + suffix + path.extension().string());
  };
  if (!arguments.html_out.empty())
    write_atomically(told_apart(arguments.html_out), gap::diagnosis_page(diagnosis, name));
  if (const fs::path out = arguments.scenario_out; !out.empty())
    write_atomically(told_apart(out),
                     enriched_study(arguments, of, diagnosis, name, out).dump(2) + '\n');
  if (!arguments.figures_out.empty())
    for (const auto& picture : gap::diagnosis_pictures(diagnosis))
      write_atomically(fs::path(arguments.figures_out) / (picture.id + suffix + ".svg"),
                       picture_file(picture));
}

/// "_x" of axis x.
std::string suffix_of(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  return '_' + name;
}

std::string called(const ToDiagnose& one) {
  auto name = fs::path(one.recording.file).filename().string();
  if (!one.recording.axis.empty()) name += ", axis " + one.recording.axis;
  return name;
}

void print_one(const DiagnoseArguments& arguments, const gap::Diagnosis& diagnosis,
               const std::string& name, Format format, Console& console) {
  if (format == Format::text) console.out << wrapped(gap::in_words(diagnosis, name)) << '\n';
  console.out << render(gap::diagnosis_tables(diagnosis, name), format);
  if (arguments.timing)
    for (const auto& [part, seconds] : diagnosis.seconds)
      console.log << fmt::format("{:<16} {:.2f} s\n", part, seconds);
}

void print_several(const std::vector<gap::FleetMember>& members, const std::string& kind,
                   Format format, Console& console) {
  if (format == Format::text) {
    const bool has_means = std::any_of(members.begin(), members.end(),
                                       [](const auto& member) { return member.mean_of > 1; });
    console.out << wrapped((has_means ? "Stretches show what is fast, sample by sample; means "
                                        "of all samples, what is slow. Of the stretches: "
                                      : "") +
                           gap::shared_in_words(members))
                << '\n';
    for (const auto& m : members) {
      const auto sources = gap::in_words(m.diagnosis.line_sources);
      console.out << wrapped(fmt::format("{}: {}{}{}", m.name, gap::answer(m.diagnosis),
                                         sources.empty() ? "" : " ", sources));
    }
    console.out << '\n';
  }
  console.out << render(gap::member_tables(members, kind), format);
}

int run(DiagnoseArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const auto& file = arguments.recording.file;
  const auto& further = arguments.simulated.further;
  for (const auto& name : arguments.options.without) (void)effect_types().named(name, "--without");
  if (!arguments.simulated.simulated.empty()) return run_simulated(arguments, format, console);
  if (!arguments.simulated.out.empty()) throw InputError("--out-simulated", "needs --simulated");
  const auto rules = arguments.watch.rules(arguments.options.significance);
  const auto all = each_of(arguments.recording, further);
  if (arguments.fleet && all.size() < 2)
    throw InputError("--fleet",
                     "1 recording; allowed: 2 or more, as A.csv B.csv, or one of several axes");
  if (all.size() > 1)
    refuse({{"--claim", !arguments.claim.empty()}},
           "is of one recording and axis, which --axis chooses");
  give_claim(arguments);
  if (arguments.watch.json_lines) {
    auto beside_tables = of_each(arguments);
    beside_tables.emplace_back("--json", !arguments.json_out.empty());
    refuse(beside_tables, "is written beside tables, not --jsonl");
    refuse({{"--claim", !arguments.claim.empty()}}, "is of one diagnosis; --jsonl prints lines");
    return diagnose_in_lines(all, arguments.span, arguments.options, rules, console);
  }
  for (const auto& out : {arguments.json_out, arguments.html_out, arguments.scenario_out})
    if (!out.empty()) require_writable(out, file);
  TemporaryPath figures;  // until there is something to write into it
  if (const fs::path folder = arguments.figures_out; !folder.empty()) {
    if (!fs::exists(folder)) figures = TemporaryPath(folder);
    make_result_folder(folder);
  }
  const std::string kind = !further.empty() ? "sensor" : all.size() > 1 ? "axis" : "part";
  const bool is_written = any(of_each(arguments)) || !arguments.claim.empty();
  const auto parts = is_written ? Parts::refused : Parts::allowed;
  std::vector<gap::FleetMember> members;
  std::vector<const ToDiagnose*> of_member;
  for (const auto& [first, end] : by_file(all)) {
    std::vector<LookedAt> axes;
    for (std::size_t k = first; k < end; ++k) {
      if (all.size() > 1) console.log << fmt::format("{} {}\n", kind, all[k].name);
      axes.push_back(looked_at(all[k], arguments.span, arguments.options, parts, console));
    }
    if (!diagnose_members(axes, arguments.options, console)) {
      console.log << "stopped early: nothing was written\n";
      return stopped;
    }
    for (std::size_t k = first; k < end; ++k) {
      auto& some = axes[k - first].members;
      of_member.insert(of_member.end(), some.size(), &all[k]);
      std::move(some.begin(), some.end(), std::back_inserter(members));
    }
  }
  if (members.empty())
    throw InputError(file, "no axis turns with rate_ref_dps; give the one that it is of");
  figures.keep();
  // Of a long recording, a stretch may be all that is left.
  const bool is_whole = members.size() == 1 && members.front().name == all.front().name;
  if (is_whole) {
    const auto name = called(all.front());
    const auto& diagnosis = members.front().diagnosis;
    if (!arguments.json_out.empty())
      write_atomically(arguments.json_out, gap::to_json(diagnosis).dump(1) + '\n');
    write_one(arguments, all.front(), diagnosis, name);
    print_one(arguments, diagnosis, name, format, console);
  } else {
    if (!arguments.json_out.empty())
      write_atomically(arguments.json_out, members_json(members, kind).dump(1) + '\n');
    std::vector<std::string> pages;
    std::set<std::string> suffixes;
    for (std::size_t k = 0; k < members.size() && is_written; ++k) {
      auto suffix = suffix_of(members[k].name);
      while (!suffixes.insert(suffix).second) suffix += '_';
      write_one(arguments, *of_member[k], members[k].diagnosis, called(*of_member[k]), suffix);
      const fs::path page = arguments.html_out;
      pages.push_back(page.stem().string() + suffix + page.extension().string());
    }
    if (!arguments.html_out.empty())
      write_atomically(arguments.html_out,
                       gap::fleet_page(members, kind, pages, fs::path(file).filename().string()));
    print_several(members, kind, format, console);
  }
  return judge_health(members, file, rules, console);
}

}  // namespace

void add_diagnose(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "diagnose",
      "find where a recording leaves the simulator, which effect causes it, and how far "
      "the gap closes once it is added");
  auto arguments = std::make_shared<DiagnoseArguments>();
  arguments->recording.add_to(verb);
  verb->add_option("further", arguments->simulated.further,
                   "further sensors of its kind: each is diagnosed, then what they share; beside "
                   "--simulated, further recordings of the same sensor");
  verb->add_flag("--fleet", arguments->fleet, "insist on several sensors, axes or parts");
  arguments->span.add_to(verb);
  verb->add_option("--simulated", arguments->simulated.simulated,
                   "traces of your own simulator: how it differs from the recording");
  verb->add_option("--out-simulated", arguments->simulated.out,
                   "folder to write these traces to, with what they lack added");
  verb->add_option("--json", arguments->json_out, "write the diagnosis as JSON");
  verb->add_option("--html", arguments->html_out, "write the diagnosis as a page with pictures");
  verb->add_option("--scenario", arguments->scenario_out,
                   "write a study whose scenario has the effects found");
  verb->add_option("--out-figures", arguments->figures_out,
                   "folder to write every picture of the page to, as SVG");
  verb->add_flag("--timing", arguments->timing, "say where the time went");
  arguments->format.add_to(verb);
  arguments->watch.add_to(verb);
  verb->add_option("--without", arguments->options.without,
                   "leave these effects out of the catalogue")
      ->delimiter(',');
  verb->add_option(
      "--claim", arguments->claim,
      "judge the effects of this study (as --scenario writes it) instead of looking for causes");
  verb->add_option("--seed", arguments->options.seed, "of all simulated noise")
      ->check(whole(0, largest_seed))
      ->capture_default_str();
  verb->footer(diagnose_examples);
  verb->callback([arguments, &console, &exit_code] { exit_code = run(*arguments, console); });
}

}  // namespace gyrostat::cli
