#include <ctime>

#include <pybind11/stl.h>

#include <gyrostat/experiments/findings/report/cell_values.hpp>
#include <gyrostat/experiments/findings/report/rank_picture.hpp>
#include <gyrostat/experiments/findings/report/report.hpp>
#include <gyrostat/experiments/findings/run_tables.hpp>
#include <gyrostat/experiments/findings/sensitivity.hpp>
#include <gyrostat/experiments/findings/study_tuning.hpp>
#include <gyrostat/experiments/run/failure_run.hpp>
#include <gyrostat/experiments/run/outcome_file.hpp>
#include <gyrostat/experiments/run/time_of_day.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/python/convert.hpp>
#include <gyrostat/python/work.hpp>
#include <gyrostat/recordings/atomic_file.hpp>

namespace gyrostat::python {
namespace {

namespace fs = std::filesystem;

/// How a run ended.
struct Ended {
  std::vector<Table> tables, timings;
  std::string stopped;  ///< why before all trials were run; empty: they were
  bool over_budget = false;
  std::uint32_t failed = 0;
};

struct RunArguments {
  std::string json, path, folder, stop, until;
  std::uint32_t trials = 0;
  int threads = 0;
  double failure_budget = -1.0;
  std::string mismatch;
};

Study study_of(const RunArguments& arguments) {
  Json json = Json::parse(arguments.json);
  if (!arguments.stop.empty()) json = with_stop(std::move(json), arguments.stop);
  Study study = parse_study(json, arguments.path);
  if (arguments.trials > 0) set_trials(study, arguments.trials);
  if (arguments.failure_budget >= 0.0) study.failure_budget = arguments.failure_budget;
  return study;
}

Mismatch mismatch_named(const std::string& name) {
  if (name == "refuse") return Mismatch::refuse;
  if (name == "mix") return Mismatch::mix;
  if (name == "set_aside") return Mismatch::set_aside;
  const std::vector<std::string> names = {"refuse", "mix", "set_aside"};
  throw InputError("mismatch", unknown_name("way", name, names));
}

Ended run(const RunArguments& arguments, Work& work) {
  constexpr std::size_t most_shown = 40;
  auto study = study_of(arguments);
  std::optional<std::time_t> until;
  if (!arguments.until.empty()) until = next_time_of_day(arguments.until, std::time(nullptr));
  make_result_folder(arguments.folder);
  Stopper stopper(work.stop, until);
  const StudyRunOptions options{.threads = arguments.threads,
                                .mismatch = mismatch_named(arguments.mismatch)};
  const RunWatcher watcher{.progress = [&](const CellProgress& now) {
    work.tell(to_text(now), now.trials ? double(now.finished) / now.trials : 1.0);
  }};
  StudyRun run(std::move(study), arguments.folder, options, stopper, watcher);
  try {
    const auto ran = run.run();
    run_failures(run.study(), run.store(), ran, arguments.folder, options, stopper.flag(), watcher);
    const auto tables = run_tables(run.study(), run.store(), ran, arguments.folder);
    write_results(arguments.folder, run.store(), tables);
    const bool over = run.over_budget();
    run.log().write("end", {{"stopped", stopper.flag().load()}, {"failed", run.failed()}});
    return {tables.with_points(most_shown), tables.timings,
            stopper.flag() && !over ? stopper.reason() : "", over, run.failed()};
  } catch (const std::exception& failure) {
    run.log().write("error", {{"what", failure.what()}});
    throw;
  }
}

/// Every finished trial below those last asked for: a row a trial and method.
py::dict outcomes(const std::string& folder) {
  struct Rows {
    std::vector<std::uint32_t> cell, trial, method;
    std::vector<double> numbers;
    Manifest manifest;
  };
  const auto rows = result_of([=] {
    Rows found;
    const Store store = Store::open(folder);
    found.manifest = store.manifest();
    for (std::uint32_t c = 0; c < found.manifest.cells.size(); ++c) {
      const auto methods = static_cast<std::uint32_t>(found.manifest.cells[c].methods.size());
      store.for_each_trial(c, found.manifest.cells[c].trials, [&](const Store::TrialView& view) {
        for (std::uint32_t m = 0; m < methods; ++m) {
          found.cell.push_back(c);
          found.trial.push_back(view.trial);
          found.method.push_back(m);
        }
        found.numbers.insert(found.numbers.end(), view.outcomes.begin(), view.outcomes.end());
      });
    }
    return std::make_shared<Rows>(std::move(found));
  });
  const auto owner = py::capsule(new std::shared_ptr<Rows>(rows), [](void* kept) {
    delete static_cast<std::shared_ptr<Rows>*>(kept);
  });
  const auto& columns = rows->manifest.columns;
  const auto indices = [&](const std::vector<std::uint32_t>& values) {
    return py::array_t<std::uint32_t>(static_cast<py::ssize_t>(values.size()), values.data(),
                                      owner);
  };
  py::list cells;
  for (const auto& cell : rows->manifest.cells)
    cells.append(py::make_tuple(cell.name, cell.methods));
  py::dict all;
  all["cells"] = cells;
  all["columns"] = columns;
  all["cell"] = indices(rows->cell);
  all["trial"] = indices(rows->trial);
  all["method"] = indices(rows->method);
  all["numbers"] =
      py::array_t<double>(std::vector<py::ssize_t>{static_cast<py::ssize_t>(rows->cell.size()),
                                                   static_cast<py::ssize_t>(columns.size())},
                          rows->numbers.data(), owner);
  return all;
}

using FailureRow = std::tuple<std::string, std::uint32_t, std::string, std::string>;

std::vector<FailureRow> failures(const std::string& folder) {
  const Store store = Store::open(folder);
  const auto manifest = store.manifest();
  std::vector<FailureRow> rows;
  store.for_each_failure([&](const Failure& failure) {
    const auto& cell = manifest.cells.at(failure.cell);
    rows.emplace_back(cell.name, failure.trial, cell.methods.at(failure.method), failure.reason);
  });
  return rows;
}

using Found = std::pair<std::vector<Table>, Drawn>;

Found rank(const std::string& folder, const std::string& metric, const std::string& only) {
  return result_of([=] {
    const Store store = Store::open(folder);
    const auto study = stored_study(store);
    const Cell* chosen = only.empty() ? nullptr : &cell_named(study, only, "cell");
    const MethodColours colours(study);
    std::vector<Table> tables;
    std::vector<Picture> pictures;
    for (std::uint32_t c = 0; c < study.cells.size(); ++c) {
      const auto& cell = study.cells[c];
      if (chosen && chosen != &cell) continue;
      const auto ranking = rank_cell(cell, trials_of(cell, store, c), metric);
      tables.push_back(ranking_table(ranking));
      auto picture = rank_picture(ranking, colours, fmt::format("ranks_{}", c + 1));
      picture.title = fmt::format("{}: mean ranks of {} over {} trials", cell.name, ranking.metric,
                                  ranking.trials);
      pictures.push_back(std::move(picture));
    }
    return Found(std::move(tables), drawn(pictures));
  });
}

std::vector<Table> sensitivity(const std::string& folder, const std::string& metric,
                               const std::string& method, bool points) {
  return result_of([=] {
    const Store store = Store::open(folder);
    const Study study = stored_study(store);
    if (study.designs.empty())
      throw InputError(folder, "the study has no \"design\", so nothing was varied by one");
    const auto found = sensitivities(study, store, {metric, method});
    auto tables = sensitivity_tables(found, study);
    if (points || tables.empty()) tables = point_tables(found, study);
    return tables;
  });
}

ReportOptions report_options(const std::vector<std::string>& cells,
                             std::optional<std::uint32_t> replay) {
  return {.cells = cells, .replay = replay};
}

std::vector<std::pair<std::string, Drawn>> pictures(const std::string& folder,
                                                    const std::vector<std::string>& cells,
                                                    std::optional<std::uint32_t> replay) {
  return result_of([=] {
    const Store store = Store::open(folder);
    std::vector<std::pair<std::string, Drawn>> all;
    for (const auto& cell :
         report_pictures(stored_study(store), store, folder, report_options(cells, replay)))
      all.emplace_back(cell.cell, drawn(cell.pictures));
    return all;
  });
}

/// What `tune` found, kept for what is asked of it.
struct Tuned {
  Study study;
  StudyTuning found;
};

/// Keyword arguments of Python by their names, as they stand in messages.
TuningRequest tuning_request(const std::string& metric, const std::string& by,
                             std::optional<double> above, const std::string& cell,
                             const std::vector<std::string>& methods,
                             const std::vector<std::string>& ranges, std::size_t budget,
                             std::uint32_t fresh) {
  TuningRequest request;
  request.metric = metric;
  request.by = by;
  request.above = above;
  request.cell = cell;
  request.methods = methods;
  request.ranges = ranges;
  request.goal.budget = budget;
  request.goal.fresh = fresh;
  request.option_prefix = "";
  return request;
}

std::shared_ptr<Tuned> tune(const std::string& json, const std::string& path,
                            const TuningRequest& request, int threads, Work& work) {
  auto study = parse_study(Json::parse(json), path);
  RunOptions options;
  options.threads = threads;
  options.stop = &work.stop;
  auto found = tune_study(study, request, options,
                          [&](const std::string& what, double share) { work.tell(what, share); });
  return std::make_shared<Tuned>(Tuned{std::move(study), std::move(found)});
}

void report(const std::string& folder, const std::string& out,
            const std::vector<std::string>& cells, std::optional<std::uint32_t> replay) {
  require_writable(out, fs::path(folder) / Store::file_name);
  result_of([=] {
    const Store store = Store::open(folder);
    write_atomically(
        out, report_page(stored_study(store), store, folder, report_options(cells, replay)));
    return true;
  });
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<Ended>(module, "Ended")
      .def_readonly("tables", &Ended::tables)
      .def_readonly("timings", &Ended::timings)
      .def_readonly("stopped", &Ended::stopped)
      .def_readonly("over_budget", &Ended::over_budget)
      .def_readonly("failed", &Ended::failed);
  module.def("run", [](const std::string& json, const std::string& path, const std::string& folder,
                       const std::string& stop, const std::string& until, std::uint32_t trials,
                       int threads, double failure_budget, const std::string& mismatch,
                       const py::object& progress) {
    const RunArguments arguments{json,   path,    folder,         stop,    until,
                                 trials, threads, failure_budget, mismatch};
    return result_of([=](Work& work) { return run(arguments, work); }, progress);
  });
  module.def("source",
             [](const std::string& folder) { return Store::open(folder).manifest().source; });
  module.def("outcomes", &outcomes);
  module.def("failures", &failures);
  module.def("rank", &rank);
  module.def("sensitivity", &sensitivity);
  py::class_<Tuned, std::shared_ptr<Tuned>>(module, "Tuned")
      .def("tables", [](const Tuned& t) { return tuning_tables(t.found.cells, t.found.goal); })
      .def("words", [](const Tuned& t) { return tuning_in_words(t.found.cells, t.found.goal); })
      .def("json", [](const Tuned& t) { return tuning_json(t.found.cells, t.found.goal).dump(); })
      .def("study", [](const Tuned& t) {
        return with_tuned_values(t.study, t.found.cells, t.study.path).dump();
      });
  module.def("tune", [](const std::string& json, const std::string& path, const std::string& metric,
                        const std::string& by, std::optional<double> above, const std::string& cell,
                        const std::vector<std::string>& methods,
                        const std::vector<std::string>& ranges, std::size_t budget,
                        std::uint32_t fresh, int threads, const py::object& progress) {
    const auto request = tuning_request(metric, by, above, cell, methods, ranges, budget, fresh);
    return result_of([=](Work& work) { return tune(json, path, request, threads, work); },
                     progress);
  });
  module.def("pictures", &pictures);
  module.def("report", &report);
}

}  // namespace gyrostat::python
