#include <gyrostat/experiments/plugins/host.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/experiments/plugins/description.hpp>
#include <gyrostat/experiments/plugins/gyrostat_plugin.h>
#include <gyrostat/experiments/plugins/protocol.hpp>

namespace gyrostat {
namespace {

static_assert(channels.size() == GYROSTAT_CHANNELS);
static_assert(sizeof(gyrostat_sample) == protocol::numbers_of_a_sample * sizeof(double));
static_assert(sizeof(gyrostat_step) == protocol::numbers_of_a_step * sizeof(double));

/// The library cannot be used, for a reason that its author can mend.
struct Unusable : std::runtime_error {
  using runtime_error::runtime_error;
};

std::string text_of(const char* text, const char* what) {
  if (text == nullptr) throw Unusable(fmt::format("{} is a null pointer", what));
  return text;
}

Json json_of(const gyrostat_parameter& parameter) {
  Json json = {{"name", text_of(parameter.name, "a parameter's name")},
               {"unit", text_of(parameter.unit, "a parameter's unit")},
               {"meaning", text_of(parameter.meaning, "a parameter's meaning")}};
  if (std::isnan(parameter.from) || std::isnan(parameter.to) || !std::isfinite(parameter.value))
    throw Unusable(fmt::format("parameter {} has {} as default in [{}, {}]", parameter.name,
                               parameter.value, parameter.from, parameter.to));
  const auto has = [&](unsigned flag) { return (parameter.range & flag) != 0; };
  if (std::isfinite(parameter.from))
    json[has(GYROSTAT_ABOVE_FROM) ? "above" : "from"] = parameter.from;
  if (std::isfinite(parameter.to)) json[has(GYROSTAT_BELOW_TO) ? "below" : "to"] = parameter.to;
  if (has(GYROSTAT_WHOLE_NUMBERS)) json["whole"] = 1;
  json["default"] = parameter.value;
  return json;
}

/// Of a filter or an effect.
template <class Plugin>
Json common_json(const Plugin& plugin, const char* kind) {
  const auto name = text_of(plugin.name, fmt::format("the name of {}", kind).c_str());
  Json json = {{"name", name},
               {"title", text_of(plugin.title, fmt::format("the title of {}", name).c_str())},
               {"parameters", Json::array()}};
  if (plugin.parameter_count > 0 && plugin.parameters == nullptr)
    throw Unusable(fmt::format("the parameters of {} are a null pointer", name));
  for (std::size_t i = 0; i < plugin.parameter_count; ++i)
    json["parameters"].push_back(json_of(plugin.parameters[i]));
  return json;
}

Json json_of(const gyrostat_filter& filter) {
  auto json = common_json(filter, "a filter");
  constexpr std::array goals = {"random_error", "thermal_drift"};
  constexpr std::array needs = {"temperature_C", "heading_deg", "truth"};
  if (filter.corrects >= goals.size())
    throw Unusable(
        fmt::format("{} corrects {}, which is no gyrostat_corrects", filter.name, filter.corrects));
  if (filter.create == nullptr || filter.step == nullptr || filter.destroy == nullptr)
    throw Unusable(fmt::format("{} lacks create, step or destroy", filter.name));
  json["corrects"] = goals[filter.corrects];
  json["needs"] = Json::array();
  for (std::size_t i = 0; i < needs.size(); ++i)
    if ((filter.needs >> i & 1U) != 0) json["needs"].push_back(needs[i]);
  return json;
}

Json json_of(const gyrostat_effect& effect) {
  auto json = common_json(effect, "an effect");
  constexpr std::array stages = {"environment", "sensing",   "noise",  "electronics",
                                 "conversion",  "transport", "compass"};
  if (effect.stage >= stages.size())
    throw Unusable(
        fmt::format("{} has stage {}, which is no gyrostat_stage", effect.name, effect.stage));
  if (effect.apply == nullptr) throw Unusable(fmt::format("{} lacks apply", effect.name));
  if (effect.parameter_count > 0 && effect.absent == nullptr)
    throw Unusable(fmt::format("{} does not say with which parameters it is absent", effect.name));
  json["stage"] = stages[effect.stage];
  json["needs"] = Json::array();
  for (std::size_t c = 0; c < channels.size(); ++c)
    if ((effect.needs >> c & 1U) != 0) json["needs"].push_back(channels[c].name);
  json["absent"] = Json::array();
  for (std::size_t i = 0; i < effect.parameter_count; ++i)
    json["absent"].push_back(effect.absent[i]);
  return json;
}

const gyrostat_plugin& library(const std::string& file) {
  void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    std::string reason = ::dlerror();
    if (reason.starts_with(file + ": ")) reason.erase(0, file.size() + 2);
    throw Unusable("cannot be loaded: " + reason);
  }
  void* symbol = ::dlsym(handle, "gyrostat_describe");
  if (symbol == nullptr)
    throw Unusable("has no function gyrostat_describe, so it is no plug-in; see gyrostat_plugin.h");
  const auto* plugin = reinterpret_cast<decltype(&gyrostat_describe)>(symbol)();
  if (plugin == nullptr) throw Unusable("gyrostat_describe gave a null pointer");
  if (plugin->abi != GYROSTAT_PLUGIN_ABI)
    throw Unusable(
        fmt::format("is built for version {} of gyrostat_plugin.h; this gyrostat has version {}",
                    plugin->abi, GYROSTAT_PLUGIN_ABI));
  if ((plugin->filter_count > 0 && plugin->filters == nullptr) ||
      (plugin->effect_count > 0 && plugin->effects == nullptr))
    throw Unusable("its filters or effects are a null pointer");
  if (plugin->filter_count + plugin->effect_count == 0)
    throw Unusable("holds no filter and no effect");
  return *plugin;
}

/// The two ends of the conversation. What the library prints itself goes to standard error.
class Ends {
 public:
  Ends() : out_(::dup(STDOUT_FILENO)) { ::dup2(STDERR_FILENO, STDOUT_FILENO); }

  /// Whether there were so many numbers before the end.
  bool read(std::span<double> to) const {
    auto bytes = std::as_writable_bytes(to);
    while (!bytes.empty()) {
      const auto count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
      if (count <= 0) return false;
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return true;
  }
  std::vector<double> read(std::size_t count) const {
    std::vector<double> numbers(count);
    if (!read(numbers)) throw Unusable("was left in the middle of a question");
    return numbers;
  }
  void write(const void* from, std::size_t size) const {
    const auto* bytes = static_cast<const char*>(from);
    while (size > 0) {
      const auto count = ::write(out_, bytes, size);
      if (count <= 0) ::_exit(0);
      bytes += count;
      size -= static_cast<std::size_t>(count);
    }
  }
  void write(const std::vector<double>& numbers) const {
    write(numbers.data(), numbers.size() * sizeof(double));
  }

 private:
  int out_;
};

void serve(const gyrostat_filter& filter, const Ends& ends) {
  std::array<void*, 2> instances{};
  std::vector<gyrostat_sample> samples;
  std::vector<double> answer;
  for (std::array<double, 2> question{}; ends.read(question);) {
    const bool is_other = question[0] >= protocol::start_other;
    auto& instance = instances[is_other];
    const auto count = static_cast<std::size_t>(question[1]);
    if (question[0] == protocol::start || question[0] == protocol::start_other) {
      const auto values = ends.read(count);
      if (instance != nullptr) filter.destroy(instance);
      instance = filter.create(values.data());
      if (instance == nullptr) throw Unusable("create gave no filter (a null pointer)");
      continue;
    }
    samples.resize(count);
    if (!ends.read(
            {reinterpret_cast<double*>(samples.data()), count * protocol::numbers_of_a_sample}))
      throw Unusable("was left in the middle of a question");
    answer.assign(1 + count * protocol::numbers_of_a_step, no_value);
    answer[0] = question[1];
    for (std::size_t i = 0; i < count; ++i)
      answer[(i + 1) * protocol::numbers_of_a_step] = GYROSTAT_OK;
    if (count > 0)
      filter.step(instance, samples.data(), reinterpret_cast<gyrostat_step*>(answer.data() + 1),
                  count);
    if (count == 0 && instance != nullptr) filter.destroy(std::exchange(instance, nullptr));
    ends.write(answer);
  }
}

/// What a gyrostat_noise points to.
struct Address {
  Noise noise;
  std::string effect;

  NormalStream stream(const char* name) const { return noise.stream(effect + "/" + name); }
};

void normals(const void* address, const char* stream, std::uint64_t first, double* out,
             std::size_t count) {
  static_cast<const Address*>(address)->stream(stream).fill(first, {out, count});
}

void uniforms(const void* address, const char* stream, std::uint64_t first, double* out,
              std::size_t count) {
  const auto from = static_cast<const Address*>(address)->stream(stream);
  for (std::size_t i = 0; i < count; ++i) out[i] = from.uniform(first + i);
}

void serve(const gyrostat_effect& effect, const Ends& ends) {
  const auto changed = changed_at(static_cast<Stage>(effect.stage));
  for (std::array<double, 2> question{}; ends.read(question);) {
    const auto count = static_cast<std::size_t>(question[1]);
    const auto head = ends.read(4);
    const auto mask = static_cast<std::uint32_t>(head[0]);
    const Address address{
        {static_cast<std::uint64_t>(head[1]) << 32U | static_cast<std::uint64_t>(head[2]),
         static_cast<std::uint32_t>(head[3])},
        effect.name};
    const auto values = ends.read(effect.parameter_count);
    std::array<std::vector<double>, GYROSTAT_CHANNELS> held;
    gyrostat_signal signal{.count = count, .channel = {}};
    for (std::size_t c = 0; c < held.size(); ++c)
      if ((mask >> c & 1U) != 0) {
        held[c] = ends.read(count);
        signal.channel[c] = held[c].data();
      }
    const gyrostat_noise noise{&address, normals, uniforms};
    effect.apply(values.data(), &signal, &noise);
    ends.write({question[1]});
    for (std::size_t c = 0; c < held.size(); ++c)
      if (std::find(changed.begin(), changed.end(), channels[c].values) != changed.end())
        ends.write(held[c]);
  }
}

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// The one called `name`, told and served.
template <class Plugin>
void serve_named(const Plugin* plugins, std::size_t count, const std::string& name,
                 const Ends& ends) {
  for (std::size_t i = 0; i < count; ++i)
    if (name == plugins[i].name) {
      const auto line = line_of(json_of(plugins[i]));
      ends.write(line.data(), line.size());
      return serve(plugins[i], ends);
    }
  throw Unusable(fmt::format("has no '{}' any more", name));
}

Json all_of(const gyrostat_plugin& plugin) {
  Json all = {{"filters", Json::array()}, {"effects", Json::array()}};
  for (std::size_t i = 0; i < plugin.filter_count; ++i)
    all["filters"].push_back(json_of(plugin.filters[i]));
  for (std::size_t i = 0; i < plugin.effect_count; ++i)
    all["effects"].push_back(json_of(plugin.effects[i]));
  return all;
}

}  // namespace

int host_plugin(const std::string& file, const std::string& kind, const std::string& name) {
  const Ends ends;
  const auto tell = [&](const Json& json) {
    const auto line = line_of(json);
    ends.write(line.data(), line.size());
  };
  try {
    const auto& plugin = library(file);
    if (kind == "filter") serve_named(plugin.filters, plugin.filter_count, name, ends);
    if (kind == "effect") serve_named(plugin.effects, plugin.effect_count, name, ends);
    if (kind.empty()) tell(all_of(plugin));
    return 0;
  } catch (const Unusable& reason) {
    if (kind.empty()) tell({{"error", reason.what()}});
    std::fprintf(stderr, "%s\n", reason.what());
    return 1;
  }
}

}  // namespace gyrostat
