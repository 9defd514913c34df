#include <pybind11/stl.h>

#include <gyrostat/python/convert.hpp>
#include <gyrostat/results/render/html.hpp>
#include <gyrostat/results/render/render.hpp>

namespace gyrostat::python {
namespace {

py::object value_of(const TableCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return py::str(*text);
  if (const auto* number = std::get_if<double>(&cell)) return py::float_(*number);
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return py::int_(*count);
  return py::none();
}

py::list rows_of(const Table& table) {
  py::list rows;
  for (const auto& row : table.rows) {
    py::list values;
    for (const auto& cell : row) values.append(value_of(cell));
    rows.append(py::tuple(values));
  }
  return rows;
}

}  // namespace

Drawn drawn(std::span<const Picture> pictures) {
  Drawn all;
  for (const auto& picture : pictures)
    if (!picture.marks.empty()) all.emplace_back(picture.id, picture.title, picture_file(picture));
  return all;
}

py::array_t<double> view_of(std::span<const double> values, const py::handle& owner) {
  py::array_t<double> view(static_cast<py::ssize_t>(values.size()), values.data(), owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

void bind_tables(py::module_& module) {
  py::class_<Table>(module, "Table")
      .def_readonly("title", &Table::title)
      .def_readonly("notes", &Table::notes)
      .def_property_readonly("columns",
                             [](const Table& table) {
                               std::vector<std::pair<std::string, std::string>> columns;
                               for (const auto& column : table.columns)
                                 columns.emplace_back(column.name, column.unit);
                               return columns;
                             })
      .def_property_readonly("rows", &rows_of)
      .def("text",
           [](const Table& table) {
             return render({&table, 1}, Format::text);
           })
      .def("html", [](const Table& table) { return html(table); });
}

}  // namespace gyrostat::python
