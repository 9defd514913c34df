#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/fields.hpp"

namespace gyrostat {

using Json = nlohmann::ordered_json;

/// One object of an input file, read key by key. Every mistake is an InputError that names file and
/// JSON path; `finish` reports keys that nobody asked for, with the nearest that were.
class JsonObject {
 public:
  JsonObject(const Json& value, std::string place) : value_(value), place_(std::move(place)) {
    if (!value_.is_object()) throw InputError(place_, "an object {...} is needed here");
  }

  bool has(const std::string& key) {
    know(key);
    return value_.contains(key);
  }

  /// The object under `key`, if there is one.
  std::optional<JsonObject> child(const std::string& key) {
    if (!has(key)) return std::nullopt;
    return JsonObject(value_.at(key), place_of(key));
  }

  /// The entries of the array under `key` with their places; empty when absent.
  std::vector<std::pair<const Json*, std::string>> list(const std::string& key) {
    std::vector<std::pair<const Json*, std::string>> entries;
    if (!has(key)) return entries;
    const Json& array = value_.at(key);
    if (!array.is_array()) throw InputError(place_of(key), "a list [...] is needed here");
    for (std::size_t i = 0; i < array.size(); ++i)
      entries.emplace_back(&array[i], fmt::format("{}[{}]", place_of(key), i));
    return entries;
  }

  std::string text(const std::string& key, std::string fallback) {
    if (!has(key)) return fallback;
    if (!value_.at(key).is_string())
      throw InputError(place_of(key), fmt::format("{} is not a text", value_.at(key).dump()));
    return value_.at(key).get<std::string>();
  }

  /// The text under a key that must be there; a key that looks like it is taken for a misspelling.
  std::string required_text(const std::string& key) {
    if (!has(key)) {
      for (const auto& [other, unused] : value_.items())
        if (is_misspelling(other, key))
          throw InputError(place_, unknown_name("key", other, std::array{key}));
      throw InputError(place_, "\"" + key + "\" is missing");
    }
    return text(key, "");
  }

  double number(const std::string& key, double fallback, const Range& range,
                std::string_view unit) {
    if (!has(key)) return fallback;
    return checked_number(value_.at(key), place_of(key), range, unit);
  }

  /// Overwrites those parameters of `p` that the object gives.
  template <class P>
  void fields(P& p) {
    for (const auto& field : P::fields()) {
      const std::string key(field.name);
      p.*(field.member) = number(key, p.*(field.member), field.range, field.unit);
    }
  }

  void finish() const {
    for (const auto& [key, unused] : value_.items())
      if (std::find(known_.begin(), known_.end(), key) == known_.end())
        throw InputError(place_, unknown_name("key", key, known_));
  }

  std::string place_of(const std::string& key) const {
    return place_ + (place_.ends_with(':') ? " " : ".") + key;
  }
  const std::string& place() const { return place_; }

  static double checked_number(const Json& value, const std::string& place, const Range& range,
                               std::string_view unit) {
    const auto shown_unit = unit.empty() || unit == "1" ? "" : fmt::format(" {}", unit);
    if (!value.is_number())
      throw InputError(place, fmt::format("{} is not a number; allowed: {}{}", value.dump(),
                                          range.to_string(), shown_unit));
    const double number = value.get<double>();
    if (!range.contains(number))
      throw InputError(place, fmt::format("{}{} is out of range; allowed: {}{}", value.dump(),
                                          shown_unit, range.to_string(), shown_unit));
    return number;
  }

 private:
  void know(const std::string& key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  }

  const Json& value_;
  std::string place_;
  std::vector<std::string> known_;
};

/// The file's JSON; InputError with line and column where it is not.
Json read_json(const std::string& path);

}  // namespace gyrostat
