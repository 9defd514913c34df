#include <gyrostat/experiments/blind/blind_export.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/temporary_path.hpp>
#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/experiments/blind/blind_check.hpp>
#include <gyrostat/experiments/blind/blind_labels.hpp>
#include <gyrostat/experiments/blind/blind_score.hpp>
#include <gyrostat/experiments/blind/seal.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::gap {
namespace {

namespace fs = std::filesystem;

constexpr auto seal_name = "sealed_labels.bin";

constexpr auto how_to_answer = R"(# {}

{} recordings of simulated or real gyros, each with no, one or several effects that the simulator as it stands (white
noise, a random walk, a T + b T' + c, white compass noise) does not have. Which, stands in `{}`, which a key opens.

`recordings/NNNNN.csv.gz` has `t_s`, `gyro_dps` and what else was recorded. An answer is a file NNNNN.json:

```json
{{"verdict": "telegraph", "effects": [{{"effect": "telegraph", "inclusion": 0.97}}, {{"effect": "outliers", "inclusion": 0.6}}]}}
```

`verdict` is the effect that matters most, `none` where the simulator makes such recordings, or `unknown` where there is
something else that has no name here. `effects`, the set with the probability of each, may be left out: it then is the
verdict alone. `verdict_set` (what cannot be ruled out) and `gap` with `closed` and `closed_interval` are scored where they are
there. What an effect may be called:

{}

`without.json`, where there is one, has by recording what its simulator lacks: an effect of these names may be there, and
is not to be named.

    gyrostat blind-check FOLDER --score ANSWERS --key KEY
)";

std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string(), "cannot be read; allowed: a folder of --export");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::string export_recordings(const BlindCheck& check, const fs::path& folder) {
  if (fs::exists(folder) && !fs::is_empty(folder))
    throw InputError(folder.string(), "is not empty; allowed: a new folder");
  // Whole or not at all: who has a part of it cannot tell what is missing.
  const auto target = fs::absolute(folder).lexically_normal();
  const auto name = (target.has_filename() ? target : target.parent_path()).string();
  TemporaryPath part(name + ".tmp");
  fs::remove_all(part.path());
  const auto labels = write_recordings(check, drawn_cases(check), part.path());
  std::vector<std::string> names;
  for (const auto& effect : catalogue()) names.push_back(fmt::format("`{}`", effect.id()));
  write_atomically(part.path() / "README.md", fmt::format(how_to_answer, check.title, labels.size(),
                                                          seal_name, fmt::join(names, ", ")));
  Json without = Json::object();
  for (const auto& label : labels)
    if (!label.without.empty()) without[fmt::format("{:05}", label.number)] = label.without;
  if (!without.empty()) write_atomically(part.path() / "without.json", without.dump(1) + '\n');
  Json secret = check.file;
  secret["seed"] = check.seed;
  secret["recordings"] = check.recordings;
  const Json all = {{"title", check.title}, {"check", secret}, {"labels", labels_json(labels)}};
  const auto key = new_key();
  write_atomically(part.path() / seal_name, sealed(all.dump(), key));
  fs::rename(part.path(), name);
  part.keep();
  return key;
}

std::vector<NamedTable> score_answers(const fs::path& folder, const fs::path& answers,
                                      const std::string& key) {
  const auto seal = folder / seal_name;
  const Json all = Json::parse(unsealed(read_bytes(seal), key, seal.string()));
  const auto labels = labels_in(all.at("labels"), seal.string());
  const auto answer_of = [&](std::size_t number, bool left_out) {
    return answers / fmt::format("{:05}.{}", number, left_out ? "without.json" : "json");
  };
  if (std::none_of(labels.begin(), labels.end(),
                   [&](const auto& label) { return fs::exists(answer_of(label.number, false)); }))
    throw InputError(
        answers.string(),
        fmt::format("has no answer; allowed: 00000.json to {:05}.json", labels.size() - 1));
  return score(all.at("title").get<std::string>(), labels, answer_of);
}

}  // namespace gyrostat::gap
