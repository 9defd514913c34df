#include <gyrostat/results/store.hpp>

#include <cstring>
#include <fstream>
#include <map>
#include <thread>

#include <gmock/gmock.h>

#include <gyrostat/core/values.hpp>
#include <gyrostat/results/store_writer.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::store_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Manifest manifest{
    "d1", "study", 7, "{}", "/", {"x", "y"}, {{"a", {"kf", "stf"}, 1000, 0}, {"b", {"kf"}, 5, 0}}};

Store store_in(const TestFolder& folder) {
  auto store = Store::open_or_create(folder.path(), manifest);
  store.set_cells(manifest.cells);
  store.begin_session({"d1", {"1", "g++", "-O3"}, "here", 1, "2026-01-01T00:00:00Z", "", 0});
  return store;
}

TrialRow row(std::uint32_t cell, std::uint32_t trial, double x = 0.0) {
  TrialRow made{cell, trial, true, {x + trial, 1.0}, {}};
  if (cell == 0) made.outcomes.insert(made.outcomes.end(), {no_value, -0.0});
  return made;
}

std::vector<std::uint32_t> trials_of(const Store& store, std::uint32_t cell) {
  std::vector<std::uint32_t> trials;
  store.for_each_trial(cell, 1000, [&](const auto& trial) { trials.push_back(trial.trial); });
  return trials;
}

TEST(Store, ReadsBackTheBitsThatWereWrittenInOrderOfTrials) {
  const TestFolder folder;
  {
    auto store = store_in(folder);
    store.write(std::vector{row(0, 9), row(0, 2)});
    store.write(std::vector{row(1, 4), row(0, 5)});
  }
  const auto store = Store::open(folder.path());
  EXPECT_THAT(trials_of(store, 0), ElementsAre(2, 5, 9));
  EXPECT_THAT(trials_of(store, 1), ElementsAre(4));
  store.for_each_trial(0, 3, [&](const auto& trial) {
    const auto expected = row(0, 2).outcomes;
    ASSERT_EQ(trial.outcomes.size(), expected.size());
    EXPECT_EQ(std::memcmp(trial.outcomes.data(), expected.data(), sizeof(double) * expected.size()),
              0);
  });
  EXPECT_EQ(store.manifest().cells[0].finished, 3U);
  EXPECT_EQ(store.manifest().cells[1].finished, 1U);
  EXPECT_EQ(store.sessions().at(0).trials, 4);
}

TEST(Store, KeepsTheFailuresOfATrialWithIt) {
  const TestFolder folder;
  auto store = store_in(folder);
  auto failed = row(0, 3);
  failed.failures = {{0, 3, 0, "threw: x"}, {0, 3, 1, "not_finite 2 steps"}};
  store.write(std::vector{failed, row(0, 4)});
  std::vector<std::string> reasons;
  store.for_each_failure([&](const Failure& f) { reasons.push_back(f.reason); });
  EXPECT_THAT(reasons, ElementsAre("threw: x", "not_finite 2 steps"));
  EXPECT_EQ(store.failed_trials(0, 1000), 1U);
  EXPECT_EQ(store.failed_trials(0, 3), 0U);
}

TEST(Store, TheSameTrialMayComeAgainButNotWithAnotherOutcome) {
  const TestFolder folder;
  auto store = store_in(folder);
  store.write(std::vector{row(0, 3)});
  store.write(std::vector{row(0, 3)});
  EXPECT_EQ(store.manifest().cells[0].finished, 1U);
  EXPECT_THAT(
      [&] {
        store.write(std::vector{row(0, 4), row(0, 3, 0.5)});
      },
      ThrowsMessage<StoreError>(HasSubstr("another outcome")));
  EXPECT_THAT(trials_of(store, 0), ElementsAre(3)) << "a batch is there whole or not at all";
}

TEST(Store, OneProcessWritesWhileOthersRead) {
  const TestFolder folder;
  auto store = store_in(folder);
  store.write(std::vector{row(0, 1)});
  EXPECT_THAT([&] { store_in(folder); },
              ThrowsMessage<StoreError>(HasSubstr("another run is writing")));
  const auto reader = Store::open(folder.path());
  EXPECT_THAT(trials_of(reader, 0), ElementsAre(1));
  store.write(std::vector{row(0, 2)});
  EXPECT_THAT(trials_of(reader, 0), ElementsAre(1, 2));
}

TEST(Store, MergingIsIdempotentAndInAnyOrderGivesTheSame) {
  const TestFolder one, two, all, reversed;
  auto first = row(0, 1);
  first.failures = {{0, 1, 1, "threw"}};
  store_in(one).write(std::vector{first, row(0, 3)});
  store_in(two).write(std::vector{row(0, 2), row(0, 3), row(1, 0)});
  auto a = store_in(all), b = store_in(reversed);
  EXPECT_EQ(a.merge(one.path()), 2U);
  EXPECT_EQ(a.merge(two.path()), 2U);
  EXPECT_EQ(a.merge(one.path()), 0U);
  EXPECT_EQ(b.merge(two.path()), 3U);
  EXPECT_EQ(b.merge(one.path()), 1U);
  for (const auto* store : {&a, &b}) {
    EXPECT_THAT(trials_of(*store, 0), ElementsAre(1, 2, 3));
    EXPECT_THAT(trials_of(*store, 1), ElementsAre(0));
    EXPECT_EQ(store->failed_trials(0, 1000), 1U);
  }
}

/// A store of a hundred trials whose file has been tampered with.
TestFolder& damaged(TestFolder& folder,
                    const std::function<void(std::fstream&, std::size_t)>& harm) {
  {
    auto store = store_in(folder);
    std::vector<TrialRow> rows;
    for (std::uint32_t t = 0; t < 1000; ++t) rows.push_back(row(0, t));
    store.write(rows);
  }
  const auto path = folder.path() / Store::file_name;
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  harm(file, std::filesystem::file_size(path));
  return folder;
}

TEST(Store, ADamagedFileIsSaidInOneLineWithWhatToDo) {
  const std::map<std::string, std::function<void(std::fstream&, std::size_t)>> harms = {
      {"the head", [](auto& file, auto) { file.seekp(0).write("nonsense nonsense", 17); }},
      {"a page",
       [](auto& file, auto size) {
         file.seekp(static_cast<std::streamoff>(size - 16384))
             .write(std::string(16384, '\x55').data(), 16384);
       }},
  };
  for (const auto& [what, harm] : harms) {
    SCOPED_TRACE(what);
    TestFolder folder;
    damaged(folder, harm);
    const auto before = folder.contents();
    EXPECT_THAT(
        [&] { trials_of(store_in(folder), 0); },
        ThrowsMessage<StoreError>(testing::AllOf(HasSubstr("is damaged"), HasSubstr("--set-aside"),
                                                 testing::Not(HasSubstr("\n")))));
    EXPECT_EQ(folder.contents().at("store.db"), before.at("store.db"));
  }
}

// SQLite keeps no checksums: a flipped bit inside an outcome is found by the store's own.
TEST(Store, OneFlippedBitOfAnOutcomeIsFound) {
  TestFolder folder;
  std::string text;
  damaged(folder, [](auto&, auto) {});
  text = folder.read("store.db");
  const double marked = 777.0;
  const auto at = text.find(std::string(reinterpret_cast<const char*>(&marked), sizeof marked));
  ASSERT_NE(at, std::string::npos);
  text[at] ^= 1;
  folder.write("store.db", text);
  EXPECT_THAT([&] { trials_of(Store::open(folder.path()), 0); },
              ThrowsMessage<StoreError>(HasSubstr("trial 777 of cell 1 fails its checksum")));
}

TEST(Store, SetAsideDestroysNothing) {
  TestFolder folder;
  damaged(folder, [](auto& file, auto) { file.seekp(0).write("nonsense", 8); });
  const auto bytes = folder.read("store.db");
  EXPECT_EQ(Store::set_aside(folder.path()), folder.path() / "store-1.db");
  EXPECT_EQ(folder.read("store-1.db"), bytes);
  EXPECT_TRUE(trials_of(store_in(folder), 0).empty());
  EXPECT_EQ(Store::set_aside(folder.path()), folder.path() / "store-2.db");
  EXPECT_EQ(Store::set_aside(folder.path()), std::nullopt);
}

TEST(StoreWriter, WritesEveryTrialOfEveryThread) {
  const TestFolder folder;
  auto store = store_in(folder);
  std::size_t heard = 0;
  {
    StoreWriter writer(store, [&](auto rows) { heard += rows.size(); });
    std::vector<std::jthread> threads;
    for (std::uint32_t t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        for (std::uint32_t i = 0; i < 250; ++i) writer.push(row(0, 4 * i + t));
      });
    threads.clear();
    writer.finish();
  }
  EXPECT_EQ(heard, 1000U);
  EXPECT_EQ(trials_of(store, 0).size(), 1000U);
}

TEST(StoreWriter, WhatEndsTheWritingIsThrownToWhoPushes) {
  const TestFolder folder;
  auto store = store_in(folder);
  store.write(std::vector{row(0, 1)});
  StoreWriter writer(store);
  writer.push(row(0, 1, 0.5));
  EXPECT_THROW(writer.finish(), StoreError);
  EXPECT_THROW(writer.push(row(0, 2)), StoreError);
}

}  // namespace
}  // namespace gyrostat::store_test
