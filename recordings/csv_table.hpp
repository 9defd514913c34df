#pragma once

#include <gyrostat/recordings/column_table.hpp>

namespace gyrostat {

class InputFile;

/// Every column of a short CSV, for formats that spread a recording over several files.
ColumnTable csv_table(InputFile& file);

}  // namespace gyrostat
