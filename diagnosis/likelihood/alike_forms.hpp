#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/diagnosis/likelihood/set_search.hpp>

namespace gyrostat::gap {

using Effects = std::vector<Effect>;
using Axes = std::vector<const FoundSet*>;

/// One form that a part may have on all axes.
struct Form {
  std::vector<Effects> told;        ///< as axes alone have it
  std::vector<std::size_t> of_set;  ///< axes whose set has it
  Effects best{};                   ///< that of one of them, or their mean
  double score = -1e300;            ///< of all, less what it costs once
};

/// The effects of a part of the sensor that an axis' set has.
Effects of_part(const FoundSet& axis, std::string_view part);
/// Each form of a part that the set of an axis has, or has as a rival; not judged yet.
std::vector<Form> forms_on(const Axes& axes, std::string_view part);
/// On all axes, with the parameters of each that has it, and with their weighted mean.
void judge(const Axes& axes, std::string_view part, Form& form);

/// That chance makes equal axes differ as those whose set has the form do, over all that is alike
/// of an effect; NaN where fewer than two say.
double p_equal(const Axes& axes, const Form& form, const Effect& effect);
/// Of each field of an effect of the form, 95 %; NaN where it is not alike, or no axis says.
std::vector<std::array<double, 2>> intervals_of(const Axes& axes, const Form& form,
                                                const Effect& effect);

}  // namespace gyrostat::gap
