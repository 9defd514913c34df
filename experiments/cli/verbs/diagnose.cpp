#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include <gyrostat/diagnosis/answer.hpp>
#include <gyrostat/diagnosis/diagnosis_tables.hpp>
#include <gyrostat/experiments/cli/diagnosed.hpp>
#include <gyrostat/experiments/cli/diagnosis_files.hpp>
#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/simulated.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/cli/watched.hpp>
#include <gyrostat/experiments/findings/member_tables.hpp>
#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat::cli {
namespace {

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
  DiagnosisFiles files;
  std::string claim;
  bool timing = false, fleet = false;
  gap::DiagnosisOptions options;
  SimulatedArguments simulated;
  WatchArguments watch;
};

int run_simulated(const DiagnoseArguments& arguments, Format format, Console& console) {
  const auto& files = arguments.files;
  refuse({{"--scenario", !files.scenario.empty()},
          {"--out-figures", !files.figures.empty()},
          {"--claim", !arguments.claim.empty()}},
         "is of gyrostat's own simulator; beside --simulated there are --html, --json and "
         "--out-simulated");
  refuse({{"--fail-if", !arguments.watch.fail_if.empty()},
          {"--baseline", !arguments.watch.baseline.empty()},
          {"--jsonl", arguments.watch.json_lines}},
         "is of recordings alone, without --simulated");
  auto traces = arguments.simulated;
  traces.json_out = files.json;
  traces.html_out = files.html;
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

/// Throws InputError where options do not go together.
void require_compatible(const DiagnoseArguments& arguments, const std::vector<ToDiagnose>& all) {
  if (!arguments.simulated.out.empty()) throw InputError("--out-simulated", "needs --simulated");
  if (arguments.fleet && all.size() < 2)
    throw InputError("--fleet",
                     "1 recording; allowed: 2 or more, as A.csv B.csv, or one of several axes");
  const Given claim = {{"--claim", !arguments.claim.empty()}};
  if (all.size() > 1) refuse(claim, "is of one recording and axis, which --axis chooses");
  if (!arguments.watch.json_lines) return;
  auto beside_tables = arguments.files.of_each();
  beside_tables.emplace_back("--json", !arguments.files.json.empty());
  refuse(beside_tables, "is written beside tables, not --jsonl");
  refuse(claim, "is of one diagnosis; --jsonl prints lines");
}

/// Members in the order of what they are of; empty where Ctrl-C ended it.
struct DiagnosedMembers {
  std::vector<gap::FleetMember> members;
  std::vector<const ToDiagnose*> of;
};

DiagnosedMembers diagnosed(const DiagnoseArguments& arguments, const std::vector<ToDiagnose>& all,
                           const std::string& kind, Console& console) {
  const bool is_written = any(arguments.files.of_each()) || !arguments.claim.empty();
  const auto parts = is_written ? Parts::refused : Parts::allowed;
  DiagnosedMembers done;
  for (const auto& [first, end] : by_file(all)) {
    std::vector<LookedAt> axes;
    for (std::size_t k = first; k < end; ++k) {
      if (all.size() > 1) console.log << fmt::format("{} {}\n", kind, all[k].name);
      axes.push_back(looked_at(all[k], arguments.span, arguments.options, parts, console));
    }
    if (!diagnose_members(axes, arguments.options, console)) return {};
    for (std::size_t k = first; k < end; ++k) {
      auto& some = axes[k - first].members;
      done.of.insert(done.of.end(), some.size(), &all[k]);
      std::ranges::move(some, std::back_inserter(done.members));
    }
  }
  if (done.members.empty())
    throw InputError(arguments.recording.file,
                     "no axis turns with rate_ref_dps; give the one that it is of");
  return done;
}

int run(DiagnoseArguments& arguments, Console& console) {
  const auto format = arguments.format.get();
  const auto& file = arguments.recording.file;
  const auto& further = arguments.simulated.further;
  for (const auto& name : arguments.options.without) (void)effect_types().named(name, "--without");
  if (!arguments.simulated.simulated.empty()) return run_simulated(arguments, format, console);
  const auto rules = arguments.watch.rules(arguments.options.significance);
  const auto all = each_of(arguments.recording, further);
  require_compatible(arguments, all);
  give_claim(arguments);
  if (arguments.watch.json_lines)
    return diagnose_in_lines(all, arguments.span, arguments.options, rules, console);
  auto figures = arguments.files.require_writable_beside(file);
  const std::string kind = !further.empty() ? "sensor" : all.size() > 1 ? "axis" : "part";
  const auto [members, of] = diagnosed(arguments, all, kind, console);
  if (members.empty()) {
    console.log << "stopped early: nothing was written\n";
    return stopped;
  }
  figures.keep();
  // Of a long recording, a stretch may be all that is left.
  if (members.size() == 1 && members.front().name == all.front().name) {
    const auto& diagnosis = members.front().diagnosis;
    arguments.files.write(all.front(), arguments.span, diagnosis);
    print_one(arguments, diagnosis, called(all.front()), format, console);
  } else {
    arguments.files.write_several(of, arguments.span, members, kind);
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
  arguments->files.add_to(verb);
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
