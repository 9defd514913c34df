#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gyrostat/results/pictures/picture.hpp>

namespace gyrostat {
namespace {

using nlohmann::ordered_json;

ordered_json numbers(const std::vector<double>& values) {
  auto list = ordered_json::array();
  for (const double v : values)
    list.push_back(std::isfinite(v) ? ordered_json(std::stod(fmt::format("{:.6g}", v)))
                                    : ordered_json(nullptr));
  return list;
}

ordered_json axis(const PictureAxis& a) {
  ordered_json out = {{"label", a.label}, {"unit", a.unit}, {"log", a.logarithmic}};
  if (!a.names.empty()) out["names"] = a.names;
  return out;
}

ordered_json mark(const Mark& m) {
  static constexpr const char* kinds[] = {"line", "points", "bars", "boxes", "cells"};
  ordered_json out = {
      {"kind", kinds[static_cast<int>(m.kind)]}, {"name", m.name}, {"colour", m.colour}};
  if (!m.shown) out["shown"] = false;
  if (m.dashed) out["dashed"] = true;
  if (m.stepped) out["stepped"] = true;
  if (m.labelled) out["labelled"] = true;
  if (m.strong) out["strong"] = true;
  const std::pair<const char*, const std::vector<double>*> columns[] = {
      {"x", &m.x},         {"y", &m.y},           {"x_low", &m.x_low}, {"x_high", &m.x_high},
      {"y_low", &m.y_low}, {"y_high", &m.y_high}, {"from", &m.from},   {"to", &m.to}};
  for (const auto& [name, values] : columns)
    if (!values->empty()) out[name] = numbers(*values);
  if (!m.labels.empty()) out["labels"] = m.labels;
  if (!m.addresses.empty()) out["addresses"] = m.addresses;
  if (!m.fills.empty()) out["fills"] = m.fills;
  return out;
}

}  // namespace

std::string picture_json(const Picture& picture) {
  ordered_json out = {
      {"id", picture.id}, {"title", picture.title}, {"x", axis(picture.x)}, {"y", axis(picture.y)}};
  if (picture.exclusive) out["exclusive"] = true;
  out["marks"] = ordered_json::array();
  for (const auto& m : picture.marks) out["marks"].push_back(mark(m));
  const auto text = out.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  std::string safe;  // no text of a study can end the script element
  for (const char c : text)
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  return safe;
}

}  // namespace gyrostat
