#pragma once

#include <gyrostat/core/fields.hpp>

namespace gyrostat {

template <class T>
struct NoParameters {
  static constexpr auto fields() { return std::array<Field<NoParameters, T>, 0>{}; }
};

}  // namespace gyrostat
