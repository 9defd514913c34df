#include <gyrostat/experiments/findings/surrogate_json.hpp>

#include <algorithm>

#include <nlohmann/json.hpp>

#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {
namespace {

Json estimate(const Estimate& e) { return {{"value", e.value}, {"low", e.low}, {"high", e.high}}; }

Json parameter(const DesignParameter& p, const SobolIndex& index) {
  Json json = {{"name", p.name},
               {"path", p.path},
               {"unit", p.unit},
               {"from", p.from},
               {"to", p.to},
               {"scale", p.logarithmic && !p.range.whole ? "log" : "linear"},
               {"first_order", estimate(index.first_order)},
               {"total", estimate(index.total)}};
  json["levels"] = p.range.whole ? Json(p.level_count()) : Json();
  return json;
}

Json surrogate(const Sensitivity& s, const Design& design) {
  const auto& found = *s.surrogate;
  Json json = {{"design", s.design},
               {"method", s.method},
               {"metric", s.metric},
               {"unit", s.unit},
               {"points", s.points},
               {"trials", s.trials},
               {"trusted", found.is_trusted},
               {"unexplained", estimate(found.unexplained)},
               {"left_out_error", found.chaos.left_out_error},
               {"trial_noise", estimate(s.noise)},
               {"parameters", Json::array()},
               {"terms", Json::array()}};
  for (std::size_t p = 0; p < design.parameters.size(); ++p)
    json["parameters"].push_back(parameter(design.parameters[p], s.indices[p]));
  for (const auto& term : found.chaos.terms)
    json["terms"].push_back({{"degrees", term.degrees}, {"coefficient", term.coefficient}});
  return json;
}

constexpr const char* how_to_compute =
    "the sum over terms of coefficient times the product over parameters of p_degree(x): x = 2 u - "
    "1 with u = (value - from) / (to - from), or the same of logarithms where the scale is log; of "
    "a parameter with levels x = (2 (value - from) + 1) / levels - 1. p_0 = 1, p_(n+1) = (x p_n - "
    "b_n p_(n-1)) / b_(n+1), b_n = n / sqrt(4 n^2 - 1), with levels times sqrt(1 - n^2 / levels^2)";

}  // namespace

std::string surrogate_json(const std::vector<Sensitivity>& sensitivities, const Study& study) {
  Json json = {{"function", how_to_compute}, {"surrogates", Json::array()}};
  for (const auto& s : sensitivities) {
    if (!s.surrogate) continue;
    const auto design = std::find_if(study.designs.begin(), study.designs.end(),
                                     [&](const Design& d) { return d.name == s.design; });
    json["surrogates"].push_back(surrogate(s, *design));
  }
  return json.dump(1) + '\n';
}

}  // namespace gyrostat
