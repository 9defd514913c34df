#pragma once

#include <string>

/// Where a build has what its tests use. One short source knows them, so that all others compile to
/// the same in any checkout.
namespace gyrostat::places {

std::string source();   ///< the folder of this checkout
std::string program();  ///< gyrostat
std::string plugins();  ///< the folder of somebody else's filters
/// The folder of real recordings: GYROSTAT_RECORDINGS, or beside the checkout; it may be absent.
std::string recordings();

}  // namespace gyrostat::places
