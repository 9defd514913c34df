#pragma once

#include <filesystem>
#include <string>

#include <gyrostat/experiments/run/trial.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/results/store.hpp>

namespace gyrostat {

/// What to do with a store that holds outcomes of another build or of a study since changed.
enum class Mismatch {
  refuse,
  mix,        ///< go on in it: cells that are the same by name and methods keep their trials
  set_aside,  ///< rename it and begin anew
};

/// The numbers of one outcome, as the store and the export name them.
std::vector<std::string> outcome_columns();

Manifest manifest_of(const Study& study);

/// The store of a study in a folder, to be written; made where there is none. Throws InputError
/// where `mismatch` refuses what is there.
Store open_study_store(const std::filesystem::path& folder, const Study& study, Mismatch mismatch);

/// Throws InputError where two stores may not be mixed: they are of other studies or other builds.
void require_same(const std::filesystem::path& into, const std::filesystem::path& from,
                  Mismatch mismatch);

/// The study that a store is of, read from what the store keeps.
Study stored_study(const Store& store);

TrialRow row_of(std::uint32_t cell, std::uint32_t trial, const Record& record);

}  // namespace gyrostat
