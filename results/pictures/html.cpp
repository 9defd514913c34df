#include <fmt/format.h>

#include <gyrostat/results/pictures/legend.hpp>
#include <gyrostat/results/render/html.hpp>

namespace gyrostat {

std::string html(const Picture& picture) {
  return fmt::format(
      "<figure class=\"picture\" id=\"{0}\">\n<figcaption><h3 "
      "id=\"{0}-title\">{1}</h3></figcaption>\n{2}"
      "<div class=\"plot\" tabindex=\"0\" role=\"group\" aria-roledescription=\"chart\" "
      "aria-labelledby=\"{0}-title\" aria-describedby=\"{0}-note\">\n{3}</div>\n"
      "<p class=\"note\" id=\"{0}-note\">{4}</p>\n<script "
      "type=\"application/json\">{5}</script>\n</figure>\n",
      escaped(picture.id), escaped(picture.title), render_detail::legend_html(picture),
      picture_svg(picture), escaped(picture.note), picture_json(picture));
}

}  // namespace gyrostat
