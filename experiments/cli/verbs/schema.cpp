#include <nlohmann/json.hpp>

#include <gyrostat/experiments/cli/options.hpp>
#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/experiments/study/study_schema.hpp>

namespace gyrostat::cli {
namespace {

constexpr const char* schema_examples = R"(Examples:
  gyrostat schema > study.schema.json
An editor completes and checks a study that names it: {"$schema": "study.schema.json", ...})";

}  // namespace

void add_schema(CLI::App& program, Console& console, int& exit_code) {
  auto* verb = program.add_subcommand(
      "schema", "the JSON Schema of study files, for editors and other programs");
  verb->footer(schema_examples);
  verb->callback([&console, &exit_code] {
    console.out << study_schema().dump(1) << '\n';
    exit_code = complete;
  });
}

}  // namespace gyrostat::cli
