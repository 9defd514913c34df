#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/chosen.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/words.hpp>
#include <gyrostat/experiments/study/json.hpp>
#include <gyrostat/experiments/study/mistakes.hpp>

namespace gyrostat {

/// One object of an input file, read key by key. Every mistake is an InputError that names file and
/// JSON path; `finish` reports keys that nobody asked for, with the nearest that were. Where there
/// are `mistakes` to gather them in, reading goes on with the fallback; else the first one is
/// thrown, as is in any case what is no object at all.
class JsonObject {
 public:
  JsonObject(const Json& value, std::string place, Mistakes* mistakes = nullptr)
      : value_(value), place_(std::move(place)), mistakes_(mistakes) {
    if (!value_.is_object()) throw InputError(place_, "an object {...} is needed here");
  }

  bool has(const std::string& key) {
    know(key);
    return value_.contains(key);
  }

  /// Another object of the same file.
  JsonObject at(const Json& value, const std::string& place) const {
    return JsonObject(value, place, mistakes_);
  }

  /// The object under `key`, if there is one.
  std::optional<JsonObject> child(const std::string& key) {
    if (!has(key)) return std::nullopt;
    return at(value_.at(key), place_of(key));
  }

  /// Calls `read` with the object under `key`, if there is one; whether there was no mistake in it.
  template <class Read>
  bool with_child(const std::string& key, const Read& read) {
    return attempt([&] {
      if (auto object = child(key)) read(*object);
    });
  }

  /// The entries of the array under `key` with their places; empty when absent.
  std::vector<std::pair<const Json*, std::string>> list(const std::string& key) {
    std::vector<std::pair<const Json*, std::string>> entries;
    if (!has(key)) return entries;
    const Json& array = value_.at(key);
    if (!array.is_array()) complain(place_of(key), "a list [...] is needed here");
    for (std::size_t i = 0; array.is_array() && i < array.size(); ++i)
      entries.emplace_back(&array[i], fmt::format("{}[{}]", place_of(key), i));
    return entries;
  }

  std::string text(const std::string& key, std::string fallback) {
    if (!has(key)) return fallback;
    if (value_.at(key).is_string()) return value_.at(key).get<std::string>();
    complain(place_of(key), fmt::format("{} is not a text", value_.at(key).dump()));
    return fallback;
  }

  /// The texts of the object under `key`, by their keys, whatever these are.
  std::map<std::string, std::string> texts(const std::string& key) {
    std::map<std::string, std::string> read;
    with_child(key, [&](JsonObject& object) {
      for (const auto& [name, unused] : object.value_.items()) read[name] = object.text(name, "");
    });
    return read;
  }

  /// The text under a key that must be there; a key that looks like it is taken for a misspelling.
  /// Nothing can be read without it, so it throws in any case.
  /// `known`: what it may be.
  std::string required_text(const std::string& key, std::span<const std::string> known = {}) {
    if (!has(key)) {
      for (const auto& [other, unused] : value_.items())
        if (is_misspelling(other, key))
          throw InputError(place_, unknown_name("key", other, std::array{key}));
      throw InputError(place_,
                       fmt::format("\"{}\" is missing{}{}", key,
                                   known.empty() ? "" : "; known: ", fmt::join(known, ", ")));
    }
    if (!value_.at(key).is_string())
      throw InputError(place_of(key), fmt::format("{} is not a text", value_.at(key).dump()));
    return value_.at(key).get<std::string>();
  }

  /// What the text under `key` names, by `convert(text, place)`, which throws for unknown names.
  template <class Convert>
  auto named(const std::string& key, const std::string& fallback, const Convert& convert) {
    auto meant = convert(fallback, place_of(key));
    attempt([&] { meant = convert(text(key, fallback), place_of(key)); });
    return meant;
  }

  double number(const std::string& key, double fallback, const Range& range,
                std::string_view unit) {
    double read = fallback;
    if (has(key))
      attempt([&] { read = checked_number(value_.at(key), place_of(key), range, unit); });
    return read;
  }

  /// Overwrites those parameters of `p` that the object gives.
  template <class P>
  requires requires { P::fields(); }
  void fields(P& p) {
    for (const auto& field : P::fields()) {
      const std::string key(field.name);
      p.*(field.member) = number(key, p.*(field.member), field.range, field.unit);
    }
  }

  /// The same of a plug-in's parameters.
  template <class Type>
  void fields(Chosen<Type>& chosen) {
    for (std::size_t i = 0; i < chosen.fields().size(); ++i) {
      const auto& field = chosen.fields()[i];
      chosen.value(i) = number(std::string(field.name), chosen.value(i), field.range, field.unit);
    }
  }

  void finish() const {
    for (const auto& [key, unused] : value_.items())
      if (std::find(known_.begin(), known_.end(), key) == known_.end())
        complain(place_, unknown_name("key", key, known_));
  }

  /// A mistake found by whoever reads the object.
  void complain(const std::string& place, const std::string& problem) const {
    attempt([&] { throw InputError(place, problem); });
  }

  /// Runs `work`, which may throw InputError; whether there was no mistake in it.
  template <class Work>
  bool attempt(const Work& work) const {
    if (mistakes_) return mistakes_->attempt(work);
    work();
    return true;
  }

  std::string place_of(const std::string& key) const {
    return place_ + (place_.ends_with(':') ? " " : ".") + key;
  }
  const std::string& place() const { return place_; }

  static double checked_number(const Json& value, const std::string& place, const Range& range,
                               std::string_view unit) {
    if (!value.is_number())
      throw InputError(place, fmt::format("{} is not a number; allowed: {}", value.dump(),
                                          values_in_words(range, unit)));
    const double number = value.get<double>();
    if (!range.contains(number)) {
      const auto shown_unit = unit.empty() || unit == "1" ? "" : fmt::format(" {}", unit);
      throw InputError(place, fmt::format("{}{} is out of range; allowed: {}", value.dump(),
                                          shown_unit, values_in_words(range, unit)));
    }
    return number;
  }

 private:
  void know(const std::string& key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  }

  const Json& value_;
  std::string place_;
  Mistakes* mistakes_;
  std::vector<std::string> known_;
};

/// The file's JSON; InputError with the line where it is not. Keys that stand twice are noted in
/// `mistakes`, or thrown.
Json read_json(const std::string& path, Mistakes* mistakes = nullptr);

}  // namespace gyrostat
