#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

namespace gyrostat {

/// The values a parameter may take: [from, to], either end open on request, whole numbers on
/// request.
struct Range {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
  bool open_from = false;
  bool open_to = false;
  bool whole = false;

  bool contains(double value) const;
  std::string to_string() const;  ///< interval notation, e.g. "[0, inf)" or "(-1, 1)"
};

/// Six significant digits, no trailing zeros.
std::string short_number(double value);

namespace ranges {
inline constexpr Range any{};
inline constexpr Range positive{.from = 0, .open_from = true};
inline constexpr Range non_negative{.from = 0};
inline constexpr Range at_least_one{.from = 1};
inline constexpr Range stationary{.from = -1, .to = 1, .open_from = true, .open_to = true};
inline constexpr Range temperature_C{.from = -273.15, .to = 1000};
inline constexpr Range flag{.from = 0, .to = 1, .whole = true};
inline constexpr Range count{.from = 1, .whole = true};
inline constexpr Range fraction{.from = 0, .to = 1};
}  // namespace ranges

/// One named number of a parameter struct. Everything that walks parameters (JSON, `list`, bounds,
/// printing) walks these.
template <class P, class T>
struct Field {
  std::string_view name;
  T P::*member;
  std::string_view unit;
  Range range;
  std::string_view doc;
};

template <class P, class T>
Field(const char*, T P::*, const char*, Range, const char*) -> Field<P, T>;

/// The field lists of bases and of `P` itself as one list of `P`.
template <class P, class T, std::size_t... N, class... B>
constexpr auto join_fields(const std::array<Field<B, T>, N>&... lists) {
  std::array<Field<P, T>, (N + ...)> joined{};
  std::size_t at = 0;
  const auto append = [&](const auto& list) {
    for (const auto& f : list) joined[at++] = {f.name, f.member, f.unit, f.range, f.doc};
  };
  (append(lists), ...);
  return joined;
}

/// A parameter without the C++ type of its owner.
struct FieldInfo {
  std::string_view name, unit;
  Range range;
  std::string_view doc;
  double value = 0.0;  ///< by default
};

/// The fields of `P` with their defaults.
template <class P>
constexpr auto field_infos() {
  constexpr auto fields = P::fields();
  std::array<FieldInfo, fields.size()> infos{};
  if constexpr (fields.size() > 0) {
    const P defaults{};
    for (std::size_t i = 0; i < fields.size(); ++i)
      infos[i] = {fields[i].name, fields[i].unit, fields[i].range, fields[i].doc,
                  defaults.*(fields[i].member)};
  }
  return infos;
}
template <class P>
inline constexpr auto field_infos_of = field_infos<P>();

/// The same parameters on another scalar (a SIMD pack, a ceres::Jet).
template <class T, template <class> class P>
P<T> cast_parameters(const P<double>& from) {
  P<T> to;
  const auto source = P<double>::fields();
  const auto target = P<T>::fields();
  for (std::size_t i = 0; i < source.size(); ++i)
    to.*(target[i].member) = T(from.*(source[i].member));
  return to;
}

}  // namespace gyrostat
