#pragma once

#include <algorithm>
#include <concepts>
#include <span>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/beside.hpp>

namespace gyrostat::gap {

/// Everything that the diagnosis knows of an effect, said in catalogue/<effect>.hpp and nowhere
/// else:
///
///   template <>
///   struct Diagnosed<effects::Mine> {
///     static constexpr auto signature = Signature::none;
///     static constexpr std::array free_parameters = {&effects::Mine::std_dps};
///     static std::vector<effects::Mine> guesses(const Beside& beside);    // where it has a law,
///     or static void enter(const effects::Mine& effect, NoiseLaw& law);      // a slow signature
///     static std::vector<effects::Mine> starts(const Evidence& evidence); // where it has another
///     static std::string why_not_assessable(const Conditions& conditions);
///     static bool is_what_it_is_called(const effects::Mine& effect, const Conditions& conditions);
///   };
///
/// CauseType says what each of them means. There are no defaults: one that is forgotten does not
/// compile. Some add `amplitudes`, `chosen_parameters`, `told_otherwise`, or `part` and `alike`.
template <class E>
struct Diagnosed;

template <class E>
concept SaysItsSignature = requires {
  { Diagnosed<E>::signature } -> std::convertible_to<Signature>;
};
template <class E>
concept SaysItsFreeParameters = requires {
  { Diagnosed<E>::free_parameters } -> std::convertible_to<std::span<double E::*const>>;
};
template <class E>
concept HasStarts = requires(const Evidence& evidence) {
  { Diagnosed<E>::starts(evidence) } -> std::same_as<std::vector<E>>;
};
template <class E>
concept HasGuesses = requires(const Beside& beside) {
  { Diagnosed<E>::guesses(beside) } -> std::same_as<std::vector<E>>;
};
template <class E>
concept IsToldOtherwise = requires(const E& effect, const Conditions& conditions) {
  { Diagnosed<E>::told_otherwise(effect, conditions) } -> std::same_as<std::vector<E>>;
};
template <class E>
concept ComesInForms = requires(const E& effect) {
  { Diagnosed<E>::chosen_parameters(effect) } -> std::same_as<std::size_t>;
};
template <class E>
concept HasLaw = requires(const E& effect, NoiseLaw& law) {
  Diagnosed<E>::enter(effect, law);
};
/// Repeated signatures start from what a set leaves, slow ones beside it.
template <class E>
concept SaysHowItStarts = (Diagnosed<E>::signature == Signature::repeated && HasStarts<E>) ||
                          (Diagnosed<E>::signature == Signature::slow && HasGuesses<E>) ||
                          Diagnosed<E>::signature == Signature::none;
template <class E>
concept SaysWhatItNeeds = requires(const Conditions& conditions) {
  { Diagnosed<E>::why_not_assessable(conditions) } -> std::same_as<std::string>;
};
template <class E>
concept SaysWhatIsPlausible = requires(const E& effect, const Conditions& conditions) {
  { Diagnosed<E>::is_what_it_is_called(effect, conditions) } -> std::same_as<bool>;
};
template <class E>
concept Diagnosable = SaysItsSignature<E> && SaysItsFreeParameters<E> && SaysHowItStarts<E> &&
    SaysWhatItNeeds<E> && SaysWhatIsPlausible<E>;

/// The catalogue's entry of an effect. A program that has described an effect of its own has it
/// among the causes by
///
///   gyrostat::gap::cause_types().add(gyrostat::gap::describe_cause<MyEffect>());
template <Diagnosable E>
CauseType describe_cause() {
  using D = Diagnosed<E>;
  const auto names_of = [](const auto& members) {
    std::vector<std::string_view> names;
    for (const auto member : members)
      for (const auto& field : E::fields())
        if (field.member == member) names.push_back(field.name);
    return names;
  };
  return {.id = effect_types().of(typeid(E)).id,
          .signature = D::signature,
          .free_parameters = names_of(D::free_parameters),
          .amplitudes =
              [] {
                if constexpr (requires { D::amplitudes; })
                  return std::size_t{D::amplitudes};
                else
                  return std::size_t{D::signature == Signature::slow};
              }(),
          .chosen_parameters =
              [] {
                using Chosen = std::size_t (*)(const Effect&);
                if constexpr (ComesInForms<E>)
                  return Chosen(
                      [](const Effect& effect) { return D::chosen_parameters(*effect.as<E>()); });
                else
                  return Chosen(nullptr);
              }(),
          .part =
              [] {
                if constexpr (requires { D::part; })
                  return std::string_view(D::part);
                else
                  return std::string_view();
              }(),
          .alike =
              [&] {
                if constexpr (requires { D::alike; })
                  return names_of(D::alike);
                else
                  return std::vector<std::string_view>();
              }(),
          .effect = [] { return Effect(E{}); },
          .starts =
              [] {
                using Starts = std::vector<Effect> (*)(const Evidence&);
                if constexpr (HasStarts<E>)
                  return Starts([](const Evidence& evidence) {
                    std::vector<Effect> all;
                    for (const E& start : D::starts(evidence)) all.emplace_back(start);
                    return all;
                  });
                else
                  return Starts(nullptr);
              }(),
          .guesses =
              [] {
                using Guesses = std::vector<Effect> (*)(const Beside&);
                if constexpr (HasGuesses<E>)
                  return Guesses([](const Beside& beside) {
                    std::vector<Effect> all;
                    for (const E& guess : D::guesses(beside)) all.emplace_back(guess);
                    return all;
                  });
                else
                  return Guesses(nullptr);
              }(),
          .told_otherwise =
              [] {
                using ToldOtherwise = std::vector<Effect> (*)(const Effect&, const Conditions&);
                if constexpr (IsToldOtherwise<E>)
                  return ToldOtherwise([](const Effect& effect, const Conditions& conditions) {
                    std::vector<Effect> all;
                    for (const E& other : D::told_otherwise(*effect.as<E>(), conditions))
                      all.emplace_back(other);
                    return all;
                  });
                else
                  return ToldOtherwise(nullptr);
              }(),
          .enter =
              [] {
                using Enter = void (*)(const Effect&, NoiseLaw&);
                if constexpr (HasLaw<E>)
                  return Enter(
                      [](const Effect& effect, NoiseLaw& law) { D::enter(*effect.as<E>(), law); });
                else
                  return Enter(nullptr);
              }(),
          .why_not_assessable = D::why_not_assessable,
          .is_what_it_is_called =
              [](const Effect& effect, const Conditions& conditions) {
                return D::is_what_it_is_called(*effect.as<E>(), conditions);
              }};  // namespace gyrostat::gap
}

}  // namespace gyrostat::gap
