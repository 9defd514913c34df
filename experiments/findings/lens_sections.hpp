#pragma once

#include <string>
#include <vector>

#include <gyrostat/experiments/findings/lens_pictures.hpp>

namespace gyrostat::gap {

/// Pictures side by side; nothing where none has anything to show.
std::string grid_of(const std::vector<Picture>& pictures);

/// A titled part of a page; nothing where the body is.
std::string section(const std::string& title, const std::string& note, const std::string& body);

/// Pictures of lenses: those still off, those that `mended` (what it is called) brought to agree,
/// those that agreed all along.
std::string lens_sections(const std::vector<LensPicture>& lenses, const std::string& mended);

}  // namespace gyrostat::gap
