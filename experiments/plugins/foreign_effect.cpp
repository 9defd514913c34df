#include <gyrostat/experiments/plugins/foreign_effect.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/experiments/plugins/protocol.hpp>

namespace gyrostat {
namespace {

/// An effect of somebody else's with its parameters, as a scenario holds it.
struct ChosenEffect {
  std::shared_ptr<const ForeignEffect> effect;
  std::vector<double> values;
};

template <class List>
bool holds(const List& list, std::vector<double> Series::*channel) {
  return std::find(list.begin(), list.end(), channel) != list.end();
}

/// In the order of `channels`, those that are sent: t_s, what is needed and what is changed.
std::vector<std::size_t> sent_channels(const EffectDescription& effect, const Series& series) {
  const auto changed = changed_at(effect.stage);
  std::vector<std::size_t> sent;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto channel = channels[c].values;
    const bool is_meant =
        channel == &Series::t_s || holds(effect.needs, channel) || holds(changed, channel);
    if (is_meant && !(series.*channel).empty()) sent.push_back(c);
  }
  return sent;
}

/// Puts the answer in the place of the channel's values.
void take(std::span<const double> answer, const Channel& channel, Series& series) {
  auto& values = series.*channel.values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isinf(answer[i]) || (std::isnan(answer[i]) && !std::isnan(values[i])))
      throw WorkerFailure(
          fmt::format("made {} of {} of {} at sample {}", answer[i], channel.name, values[i], i));
    values[i] = answer[i];
  }
}

}  // namespace

void ForeignEffect::apply_in(Worker& worker, std::span<const double> values, Series& series,
                             const Noise& noise) const {
  const auto is_absent = [&](auto channel) { return (series.*channel).empty(); };
  const auto& needs = description->needs;
  if (std::any_of(needs.begin(), needs.end(), is_absent)) return;
  const auto sent = sent_channels(*description, series);
  const auto changed = changed_at(description->stage);
  double mask = 0.0;
  std::size_t answers = 0;
  for (const auto c : sent) {
    mask += std::ldexp(1.0, static_cast<int>(c));
    answers += holds(changed, channels[c].values);
  }
  std::vector<double> question = {protocol::apply,
                                  static_cast<double>(series.size()),
                                  mask,
                                  static_cast<double>(noise.seed >> 32U),
                                  static_cast<double>(noise.seed & 0xffffffffU),
                                  static_cast<double>(noise.trial)};
  question.insert(question.end(), values.begin(), values.end());
  for (const auto c : sent) {
    const auto& channel = series.*channels[c].values;
    question.insert(question.end(), channel.begin(), channel.end());
  }
  std::vector<double> answer(1 + answers * series.size(), no_value);
  try {
    worker.exchange(question, answer);
    if (answer[0] != static_cast<double>(series.size()))
      throw WorkerFailure(fmt::format("answered garbage: {}", answer[0]));
    std::span<const double> rest(answer);
    rest = rest.subspan(1);
    for (const auto c : sent) {
      if (!holds(changed, channels[c].values)) continue;
      take(rest.first(series.size()), channels[c], series);
      rest = rest.subspan(series.size());
    }
  } catch (const WorkerFailure& failure) {
    throw WorkerFailure(fmt::format("{} {}", description->name, failure.what()));
  }
}

void ForeignEffect::apply(std::span<const double> values, Series& series,
                          const Noise& noise) const {
  workers->with_one([&](Worker& worker) { apply_in(worker, values, series, noise); });
}

EffectType effect_type_of(const ForeignEffect& effect) {
  const auto shared = std::make_shared<const ForeignEffect>(effect);
  const auto& d = *shared->description;
  EffectType type;
  type.id = d.name;
  type.title = d.title;
  type.fields = d.fields;
  type.cpp_type = &typeid(ChosenEffect);
  type.make = [shared] { return std::any(ChosenEffect{shared, shared->description->defaults()}); };
  type.parameter = [](std::any& plugin, std::size_t field) -> double& {
    return std::any_cast<ChosenEffect>(&plugin)->values.at(field);
  };
  type.stage = d.stage;
  type.needs = d.needs;
  type.apply = [](const std::any& plugin, Series& series, const Noise& noise) {
    const auto& chosen = *std::any_cast<ChosenEffect>(&plugin);
    chosen.effect->apply(chosen.values, series, noise);
  };
  type.code = effect.workers->code();
  return type;
}

}  // namespace gyrostat
