#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace gyrostat {

/// A string that can be a template argument.
template <std::size_t N>
struct FixedString {
  std::array<char, N> text{};
  constexpr FixedString(const char (&from)[N]) { std::copy_n(from, N, text.begin()); }  // NOLINT
  constexpr operator std::string_view() const { return {text.data(), N - 1}; }          // NOLINT
};

/// A type under the name of the file that it lives in.
template <FixedString Id, class Type>
struct Plugin {
  static constexpr std::string_view id = Id;
  using type = Type;
};

/// A template over its scalar under the name of the file that it lives in.
template <FixedString Id, template <class> class Template>
struct ScalarPlugin {
  static constexpr std::string_view id = Id;
  template <class T>
  using on = Template<T>;
  using type = Template<double>;
};

/// The plug-ins of one folder, as CMake listed them.
template <class... Plugins>
struct PluginList {
  template <class Visitor>
  static void for_each(Visitor&& visit) {
    (visit(Plugins{}), ...);
  }
};

}  // namespace gyrostat
