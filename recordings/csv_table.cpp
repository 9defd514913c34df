#include <gyrostat/recordings/csv_table.hpp>

#include <gyrostat/core/error.hpp>
#include <gyrostat/recordings/csv_header.hpp>
#include <gyrostat/recordings/csv_rows.hpp>
#include <gyrostat/recordings/input_file.hpp>
#include <gyrostat/recordings/line_blocks.hpp>

namespace gyrostat {

ColumnTable csv_table(InputFile& file) {
  LineBlocks blocks(file);
  auto lines = blocks.next();
  const auto header = take_header(lines, file.place());
  ColumnTable table;
  table.names = header.names;
  table.values.resize(header.names.size());
  std::vector<std::vector<double>*> targets;
  for (auto& column : table.values) targets.push_back(&column);
  CsvRows rows(header, targets, file.place());
  for (; !lines.empty(); lines = blocks.next()) rows.feed(lines);
  if (table.values.empty() || table.values.front().empty())
    throw InputError(file.place(), "has no samples; required: at least one");
  return table;
}

}  // namespace gyrostat
