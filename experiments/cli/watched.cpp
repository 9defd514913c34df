#include <gyrostat/experiments/cli/watched.hpp>

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat::cli {

void WatchArguments::add_to(CLI::App* verb) {
  std::string numbers;
  for (const auto& number : gap::health_numbers())
    numbers += (numbers.empty() ? "" : ", ") + std::string(number.name);
  verb->add_option("--fail-if", fail_if,
                   "exit with 5 where that holds, as 'gap>2', 'p<0.001' or 'vibration>0.9'; "
                   "numbers: " +
                       numbers + ", or an effect, for the probability that it is there")
      ->type_name("RULE");
  verb->add_option("--baseline", baseline,
                   "a study whose simulator the recording is held to, in place of looking for "
                   "causes: yesterday's, as --scenario wrote it")
      ->type_name("STUDY");
  verb->add_flag("--jsonl", json_lines,
                 "print a line of JSON a recording, and go on where one cannot be read");
}

std::vector<gap::HealthRule> WatchArguments::rules(double significance) const {
  std::vector<gap::HealthRule> all;
  for (const auto& text : fail_if) all.emplace_back(text, "--fail-if");
  if (all.empty() && !baseline.empty())
    all.emplace_back(fmt::format("p<{:g}", significance), "--baseline");
  return all;
}

void WatchArguments::give_baseline(gap::DiagnosisOptions& options) const {
  if (!baseline.empty()) options.claim = read_study(baseline).cells.front().scenario;
}

int judge_health(const std::vector<gap::FleetMember>& members, const std::string& file,
                 const std::vector<gap::HealthRule>& rules, Console& console) {
  int code = complete;
  for (const auto& member : members)
    for (const auto& rule : rules) {
      if (!rule.is_broken_by(member.diagnosis)) continue;
      console.log << fmt::format("{}: {}\n", member.name.empty() ? file : member.name,
                                 rule.told(member.diagnosis));
      code = unhealthy;
    }
  return code;
}

int diagnose_in_lines(const std::vector<ToDiagnose>& all, const SpanOption& span,
                      const gap::DiagnosisOptions& options,
                      const std::vector<gap::HealthRule>& rules, Console& console) {
  bool unread = false, failed = false;
  const auto print = [&](const nlohmann::ordered_json& line) {
    console.out << line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
  };
  const auto line_of = [](const ToDiagnose& one) {
    nlohmann::ordered_json line = {{"file", one.recording.file}};
    if (!one.recording.axis.empty()) line["axis"] = one.recording.axis;
    return line;
  };
  for (const auto& [first, end] : by_file(all)) {
    std::vector<LookedAt> axes(end - first);
    std::vector<std::string> mistakes(end - first);
    for (std::size_t k = first; k < end; ++k) try {
        axes[k - first] = looked_at(all[k], span, options, Parts::allowed, console);
      } catch (const InputError& mistake) {
        mistakes[k - first] = mistake.what();
      }
    try {
      if (!diagnose_members(axes, options, console)) {
        console.log << "stopped early\n";
        return stopped;
      }
    } catch (const InputError& mistake) {
      for (std::size_t k = 0; k < axes.size(); ++k)
        if (mistakes[k].empty()) mistakes[k] = mistake.what();
    }
    for (std::size_t k = first; k < end; ++k) {
      const auto line = line_of(all[k]);
      if (const auto& mistake = mistakes[k - first]; !mistake.empty()) {
        unread = true;
        auto told = line;
        told["error"] = mistake;
        print(told);
        continue;
      }
      const auto& members = axes[k - first].members;
      for (const auto& member : members) {
        auto told = line;
        if (members.size() > 1) told["part"] = member.name;
        told.update(gap::health_json(member.diagnosis, rules));
        failed = failed || !told["failed"].empty();
        print(told);
      }
    }
  }
  return unread ? usage : failed ? unhealthy : complete;
}

}  // namespace gyrostat::cli
