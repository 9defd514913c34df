#pragma once

#include <any>
#include <concepts>
#include <functional>
#include <span>
#include <string_view>
#include <typeinfo>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/registry.hpp>

namespace gyrostat {

/// What is known of a plug-in that is a struct of parameters, without its C++ type.
struct ParametricType {
  std::string_view id, title;
  std::span<const FieldInfo> fields;
  const std::type_info* cpp_type = nullptr;
  std::function<std::any()> make{};  ///< with its defaults
  double& (*parameter)(std::any& plugin, std::size_t field) = nullptr;
};

template <class P>
ParametricType describe_parametric(std::string_view id) {
  return {.id = id,
          .title = P::title,
          .fields = field_infos_of<P>,
          .cpp_type = &typeid(P),
          .make = [] { return std::any(P{}); },
          .parameter = [](std::any& plugin, std::size_t field) -> double& {
            auto* parameters = std::any_cast<P>(&plugin);
            if constexpr (P::fields().size() > 0)
              return parameters->*(P::fields()[field].member);
            else
              throw std::out_of_range(std::string(P::title));
          }};
}

/// One plug-in of a kind, by value, with its parameters: as a C++ type to those who know it, as a
/// list of named numbers to those who do not.
template <class Type>
class Chosen {
 public:
  /// With its defaults.
  explicit Chosen(const Type& type) : type_(&type), plugin_(type.make()) {}
  template <class P>
  requires(!std::same_as<P, Chosen> && !std::same_as<P, Type>) Chosen(P plugin)  // NOLINT
      : type_(&Registry<Type>::all().of(typeid(P))), plugin_(std::move(plugin)) {}

  const Type& type() const { return *type_; }
  std::string_view id() const { return type_->id; }
  std::span<const FieldInfo> fields() const { return type_->fields; }
  const std::any& plugin() const { return plugin_; }

  double value(std::size_t field) const {
    return type_->parameter(const_cast<std::any&>(plugin_), field);  // which reads it
  }
  double& value(std::size_t field) { return type_->parameter(plugin_, field); }

  /// As the type that it is; nullptr where it is another.
  template <class P>
  const P* as() const {
    return std::any_cast<P>(&plugin_);
  }

 private:
  const Type* type_;
  std::any plugin_;
};

}  // namespace gyrostat
