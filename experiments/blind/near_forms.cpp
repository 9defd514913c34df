#include <gyrostat/experiments/blind/near_forms.hpp>

#include <algorithm>
#include <deque>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/experiments/blind/forms/filtered_output.hpp>
#include <gyrostat/experiments/blind/forms/heavy_tails.hpp>
#include <gyrostat/experiments/blind/forms/one_sided_scale.hpp>
#include <gyrostat/experiments/blind/forms/output_dead_zone.hpp>
#include <gyrostat/experiments/blind/forms/second_order_compass.hpp>
#include <gyrostat/experiments/blind/forms/second_order_lag.hpp>
#include <gyrostat/experiments/blind/forms/truncation.hpp>

namespace gyrostat::gap {
namespace {

const std::deque<NearForm>& near_forms() {
  static const std::deque<NearForm> all = {
      {describe_effect<forms::FilteredOutput>("filtered_output"),
       {"noise_bandwidth", "sensor_bandwidth"}},
      {describe_effect<forms::HeavyTails>("heavy_tails"), {"outliers"}},
      {describe_effect<forms::OneSidedScale>("one_sided_scale"),
       {"scale_asymmetry", "scale_factor"}},
      {describe_effect<forms::OutputDeadZone>("output_dead_zone"), {"dead_zone"}},
      {describe_effect<forms::SecondOrderCompass>("second_order_compass"), {"compass_lag"}},
      {describe_effect<forms::SecondOrderLag>("second_order_lag"), {"thermal_lag"}},
      {describe_effect<forms::Truncation>("truncation"), {"quantization"}},
  };
  return all;
}

}  // namespace

const NearForm& near_form(std::string_view id, std::string_view effect, std::string_view place) {
  std::vector<std::string> ids;
  for (const auto& form : near_forms()) {
    ids.emplace_back(form.type.id);
    if (form.type.id != id) continue;
    if (std::find(form.names.begin(), form.names.end(), effect) == form.names.end())
      throw InputError(place, fmt::format("'{}' is no form of {}; it is one of {}", id, effect,
                                          fmt::join(form.names, ", ")));
    return form;
  }
  throw InputError(place, unknown_name("form", id, ids));
}

}  // namespace gyrostat::gap
