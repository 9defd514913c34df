#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace gyrostat::gap {

/// What a diagnosis comes to. As text "none", "unknown" or the name of the effect.
class Verdict {
 public:
  /// The simulator makes recordings like this one.
  static Verdict none() { return {Kind::none, {}}; }
  /// There is a gap that no effect of the catalogue explains.
  static Verdict unknown() { return {Kind::unknown, {}}; }
  static Verdict cause(std::string_view effect) { return {Kind::cause, std::string(effect)}; }
  /// The verdict that has this text.
  static Verdict of(std::string_view text) {
    for (const auto& verdict : {none(), unknown()})
      if (verdict.text() == text) return verdict;
    return cause(text);
  }

  bool is_none() const { return kind_ == Kind::none; }
  bool is_unknown() const { return kind_ == Kind::unknown; }
  bool names(std::string_view effect) const { return kind_ == Kind::cause && effect_ == effect; }
  std::string text() const { return is_none() ? "none" : is_unknown() ? "unknown" : effect_; }

  friend bool operator==(const Verdict&, const Verdict&) = default;

 private:
  enum class Kind { none, unknown, cause };
  Verdict(Kind kind, std::string effect) : kind_(kind), effect_(std::move(effect)) {}

  Kind kind_;
  std::string effect_;
};

}  // namespace gyrostat::gap
