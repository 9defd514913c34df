#include <gyrostat/results/pictures/labels.hpp>

#include <algorithm>

#include <gyrostat/results/pictures/drawing.hpp>
#include <gyrostat/results/pictures/lettering.hpp>

namespace gyrostat::render_detail {

void Labels::add(double x, double y, const std::string& text) { labels_.push_back({x, y, text}); }

std::string Labels::svg(const Frame& f) const {
  using Box = std::array<double, 4>;
  std::vector<Box> taken;
  for (const auto& l : labels_) taken.push_back({l.x - 5, l.y - 4, l.x + 5, l.y + 4});
  std::string out;
  for (const auto& [x, y, text] : labels_) {
    const double w = length_of(text);
    const std::array<std::array<double, 2>, 8> spots = {{{x + 6, y - 17},
                                                         {x - 6 - w, y - 17},
                                                         {x + 7, y - 6},
                                                         {x - 7 - w, y - 6},
                                                         {x + 6, y + 5},
                                                         {x - 6 - w, y + 5},
                                                         {x - w / 2, y - 20},
                                                         {x - w / 2, y + 7}}};
    for (const auto& [left, up] : spots) {
      const Box box = {left, up, left + w, up + 13};
      const bool free = left > f.left && left + w < f.width && up > 0.0 &&
                        up + 13 < f.height - f.bottom &&
                        std::none_of(taken.begin(), taken.end(), [&](const Box& b) {
                          return box[0] < b[2] && b[0] < box[2] && box[1] < b[3] && b[1] < box[3];
                        });
      if (!free) continue;
      taken.push_back(box);
      out += text_at(left, up + 10, text, "start");
      break;
    }
  }
  return out;
}

}  // namespace gyrostat::render_detail
