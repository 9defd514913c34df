#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/error.hpp"

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
  /// Any one of the plug-ins, by value.
  using Any = std::variant<typename Plugins::type...>;

  static std::vector<std::string> ids() { return {std::string(Plugins::id)...}; }

  template <class Visitor>
  static void for_each(Visitor&& visit) {
    (visit(Plugins{}), ...);
  }

  /// Calls `visit` with the plug-in named `id`; throws InputError at `place` when there is none.
  template <class Visitor>
  static void with(std::string_view place, std::string_view kind, std::string_view id,
                   Visitor&& visit) {
    bool found = false;
    const auto consider = [&](auto plugin) {
      if (!found && plugin.id == id) {
        found = true;
        visit(plugin);
      }
    };
    (consider(Plugins{}), ...);
    if (!found) throw InputError(place, unknown_name(kind, id, ids()));
  }

  static std::string_view id_of(const Any& any) {
    constexpr std::array<std::string_view, sizeof...(Plugins)> names = {Plugins::id...};
    return names[any.index()];
  }
};

}  // namespace gyrostat
