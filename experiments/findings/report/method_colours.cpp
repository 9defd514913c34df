#include <gyrostat/experiments/findings/report/method_colours.hpp>

#include <fmt/format.h>

namespace gyrostat {

MethodColours::MethodColours(const Study& study) {
  constexpr std::size_t colours = 8;  // of the page's style
  std::size_t next = 0;
  for (const auto& cell : study.cells)
    for (const auto& method : cell.methods) {
      if (looks_.contains(method.id)) continue;
      if (method.role().is_floor())
        looks_[method.id] = {"none", false};
      else if (method.role().is_bound())
        looks_[method.id] = {"oracle", true};
      else {
        looks_[method.id] = {fmt::format("m{}", next % colours), next / colours % 2 == 1};
        ++next;
      }
    }
}

Mark MethodColours::mark(Mark::Kind kind, const std::string& method) const {
  const auto& look = looks_.at(method);
  Mark mark;
  mark.kind = kind;
  mark.name = method;
  mark.colour = look.colour;
  mark.dashed = look.dashed;
  return mark;
}

}  // namespace gyrostat
