#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <gyrostat/diagnosis/diagnosis.hpp>

namespace gyrostat::gap {

/// A number of a diagnosis that a rule may hold a recording to.
struct HealthNumber {
  std::string_view name, unit, meaning;
  double (*of)(const Diagnosis& diagnosis);
};
const std::vector<HealthNumber>& health_numbers();

/// What a recording fails by: "gap>2". The number is one of `health_numbers()`, or an effect: the
/// probability that it is there.
class HealthRule {
 public:
  /// Throws InputError at `place` where the text is no rule.
  HealthRule(std::string text, std::string_view place);

  const std::string& text() const { return text_; }
  double number_of(const Diagnosis& diagnosis) const;
  bool is_broken_by(const Diagnosis& diagnosis) const;
  /// "gap>2 holds: gap is 3.1 spreads".
  std::string told(const Diagnosis& diagnosis) const;

 private:
  std::string text_, name_, comparison_;
  double limit_ = 0.0;
};

/// For a line of a log: all numbers, the verdict, each effect with the probability that it is
/// there, the rules that were broken.
nlohmann::ordered_json health_json(const Diagnosis& diagnosis,
                                   const std::vector<HealthRule>& rules);

}  // namespace gyrostat::gap
