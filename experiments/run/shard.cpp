#include <gyrostat/experiments/run/shard.hpp>

#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>

namespace gyrostat {
namespace {

constexpr std::int64_t most_shards = 1'000'000;

/// The number that `text` consists of; -1 where it is none.
std::int64_t whole_number(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  return failure == std::errc() && end == text.data() + text.size() ? std::int64_t{value} : -1;
}

}  // namespace

std::string Shard::folder() const { return fmt::format("shard_{}_of_{}", index, count); }

Shard parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  const auto index = whole_number(std::string_view(text).substr(0, slash));
  const auto count =
      slash == std::string::npos ? -1 : whole_number(std::string_view(text).substr(slash + 1));
  if (index < 1 || index > count || count > most_shards)
    throw InputError("--shard", fmt::format("'{}' is no shard; allowed: i/n with 1 <= i <= n <= {}",
                                            text, most_shards));
  return {static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(count)};
}

std::optional<Shard> slurm_shard(const std::function<const char*(const char*)>& environment) {
  if (!environment("SLURM_ARRAY_TASK_ID")) return std::nullopt;
  const auto number = [&](const char* name) {
    const char* text = environment(name);
    const auto value = whole_number(text ? text : "");
    if (value < 0)
      throw InputError(name, fmt::format("'{}' is not a task number", text ? text : ""));
    return static_cast<std::uint32_t>(value);
  };
  const auto id = number("SLURM_ARRAY_TASK_ID"), least = number("SLURM_ARRAY_TASK_MIN"),
             most = number("SLURM_ARRAY_TASK_MAX"), count = number("SLURM_ARRAY_TASK_COUNT");
  if (count != most - least + 1 || id < least || id > most)
    throw InputError(
        "SLURM_ARRAY_TASK_ID",
        fmt::format("the array has {} tasks from {} to {}; with gaps state --shard i/n", count,
                    least, most));
  return Shard{id - least + 1, count};
}

}  // namespace gyrostat
