#pragma once

#include <filesystem>

namespace gyrostat {

/// Throws InputError where a MATLAB file is not whole: matio reads what is missing, or does not
/// unpack, as zeros. Version 5 is walked element by element; of 7.3 the signature is checked, the
/// rest by HDF5. Older versions are refused.
void require_whole_mat(const std::filesystem::path& path);

}  // namespace gyrostat
