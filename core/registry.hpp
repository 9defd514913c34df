#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include <gyrostat/core/error.hpp>

namespace gyrostat {

/// The plug-ins of one kind, each as its description: those of this project in the order of their
/// names, then those that a program added. `Type` has `id`, `kind` (what messages call it) and
/// `describe_all`, which appends the project's own.
///
/// Thread safety: reading is safe from any number of threads. `add` is for the start of a program,
/// before anything is read from other threads.
template <class Type>
class Registry {
 public:
  static Registry& all() {
    static Registry registry;
    return registry;
  }

  auto begin() const { return types_.begin(); }
  auto end() const { return types_.end(); }
  std::size_t size() const { return types_.size(); }
  const Type& operator[](std::size_t i) const { return types_[i]; }

  std::vector<std::string> ids() const {
    std::vector<std::string> ids;
    for (const auto& type : types_) ids.emplace_back(type.id);
    return ids;
  }

  /// The one called `id`; nullptr where there is none.
  const Type* find(std::string_view id) const {
    for (const auto& type : types_)
      if (type.id == id) return &type;
    return nullptr;
  }

  /// The one called `id`; throws InputError at `place` otherwise, with the nearest name.
  const Type& named(std::string_view id, std::string_view place) const {
    if (const auto* type = find(id)) return *type;
    throw InputError(place, unknown_name(Type::kind, id, ids()));
  }

  /// Of those whose plug-in is a C++ type with parameters: the one of that type. Throws
  /// std::logic_error for a type that was never described.
  const Type& of(const std::type_info& cpp_type) const {
    for (const auto& type : types_)
      if (*type.cpp_type == cpp_type) return type;
    throw std::logic_error(std::string(cpp_type.name()) + " is not registered");
  }

  /// Adds a plug-in of the program's own. Throws InputError where the name is taken.
  void add(Type type) {
    if (find(type.id))
      throw InputError(type.id, "there is a " + std::string(Type::kind) + " of this name");
    types_.push_back(std::move(type));
  }

  /// The same, but one of this name that the program added before is described anew, for programs
  /// in which code is written while they run. As with `add`, nothing else may read meanwhile.
  void add_or_replace(Type type) {
    for (std::size_t i = own_; i < types_.size(); ++i)
      if (types_[i].id == type.id) {
        types_[i] = std::move(type);
        return;
      }
    add(std::move(type));
  }

 private:
  Registry() {
    Type::describe_all(types_);
    own_ = types_.size();
  }

  std::deque<Type> types_;  ///< whose elements stay where they are
  std::size_t own_ = 0;     ///< so many are the project's
};

}  // namespace gyrostat
