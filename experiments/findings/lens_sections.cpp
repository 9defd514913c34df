#include <gyrostat/experiments/findings/lens_sections.hpp>

#include <fmt/format.h>

#include <gyrostat/results/render/html.hpp>

namespace gyrostat::gap {
namespace {

std::string of_agreement(const std::vector<LensPicture>& all, Agreement agreement) {
  std::vector<Picture> pictures;
  for (const auto& lens : all)
    if (lens.agreement == agreement) pictures.push_back(lens.picture);
  return grid_of(pictures);
}

}  // namespace

std::string grid_of(const std::vector<Picture>& pictures) {
  std::string out;
  for (const auto& picture : pictures)
    if (!picture.marks.empty()) out += html(picture);
  return out.empty() ? "" : "<div class=\"pictures\">\n" + out + "</div>\n";
}

std::string section(const std::string& title, const std::string& note, const std::string& body) {
  if (body.empty()) return "";
  return fmt::format("<section><h2>{}</h2>\n<p class=\"note\">{}</p>\n{}</section>\n",
                     escaped(title), escaped(note), body);
}

std::string lens_sections(const std::vector<LensPicture>& lenses, const std::string& mended) {
  return section("Where the simulator is still off", "The clearest first.",
                 of_agreement(lenses, Agreement::still_off)) +
         section("What " + mended + " mended", "The clearest first.",
                 of_agreement(lenses, Agreement::mended)) +
         section("Where it agreed all along",
                 "Neither with nor without the effects is it seen off.",
                 of_agreement(lenses, Agreement::always));
}

}  // namespace gyrostat::gap
