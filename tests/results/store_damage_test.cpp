// What a disk, a stray write or a careless hand does to a store is noticed by whoever reads it, or
// changes nothing of what is read.

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/results/store.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::store_damage_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

constexpr std::uint32_t trials = 600;
constexpr std::size_t page_size = 16384;
const Manifest manifest{"digest",
                        "study",
                        7,
                        R"({"cells": [{"scenario": {"random_error": {"phi": 0.5}}}]})",
                        "/folder",
                        {"x", "y"},
                        {{"a", {"kf", "stf"}, trials, 0}, {"b", {"kf"}, 5, 0}}};

std::vector<TrialRow> rows_from(std::uint32_t first, std::uint32_t last) {
  std::vector<TrialRow> rows;
  for (auto t = first; t < last; ++t) {
    rows.push_back({0, t, true, {t + 0.25, 1.0, -0.5 * t, 3.0}, {}});
    if (t % 50 == 0) rows.back().failures = {{0, t, 1, fmt::format("not_finite {} steps", t)}};
  }
  return rows;
}

Store begun(const TestFolder& folder) {
  auto store = Store::open_or_create(folder.path(), manifest);
  store.set_cells(manifest.cells);
  store.begin_session({"digest", {"1", "g++", "-O3"}, "here", 1, "2026-01-01T00:00:00Z", "{}", 0});
  return store;
}

void fill(const TestFolder& folder) {
  auto store = begun(folder);
  store.write(rows_from(0, trials));
  store.write(std::vector{TrialRow{1, 3, false, {1.0, 2.0}, {}}});
}

/// All that a reader may ask for; only what a session notes of its progress is not vouched for.
std::string everything_in(const fs::path& folder) {
  const auto store = Store::open(folder);
  const auto m = store.manifest();
  auto text = fmt::format("{} {} {} {} {}\n", m.digest, m.name, m.seed, m.source, m.folder);
  for (const auto& column : m.columns) text += column + ' ';
  for (const auto& session : store.sessions())
    text += fmt::format("{} {} {} {} {} {} {} {}\n", session.digest, session.build.version,
                        session.build.compiler, session.build.flags, session.machine,
                        session.process, session.started, session.trials);
  for (std::uint32_t c = 0; c < m.cells.size(); ++c) {
    text += fmt::format("{} {} {}\n", m.cells[c].name, m.cells[c].trials, m.cells[c].finished);
    for (const auto& method : m.cells[c].methods) text += method + ' ';
    store.for_each_trial(c, m.cells[c].trials, [&](const auto& trial) {
      text += fmt::format("{} {}", trial.trial, trial.calibrated);
      for (const double x : trial.outcomes) text += fmt::format(" {}", x);
      text += '\n';
    });
  }
  store.for_each_failure([&](const Failure& f) {
    text += fmt::format("{} {} {} {}\n", f.cell, f.trial, f.method, f.reason);
  });
  return text;
}

/// Everything, or nothing where damage was said.
std::string read_or_refused(const fs::path& folder) {
  try {
    return everything_in(folder);
  } catch (const StoreError&) {
    return "";
  }
}

class Patch {
 public:
  Patch(const fs::path& path, std::size_t at, unsigned char mask)
      : file_(::open(path.c_str(), O_RDWR)), at_(static_cast<off_t>(at)), mask_(mask) {
    flip();
  }
  ~Patch() {
    flip();
    ::close(file_);
  }
  Patch(const Patch&) = delete;
  Patch& operator=(const Patch&) = delete;

 private:
  void flip() const {
    unsigned char byte = 0;
    EXPECT_EQ(::pread(file_, &byte, 1, at_), 1);
    byte ^= mask_;
    EXPECT_EQ(::pwrite(file_, &byte, 1, at_), 1);
  }
  int file_;
  off_t at_;
  unsigned char mask_;
};

TEST(StoreDamage, NoFlippedBitOfAnyPageChangesWhatIsReadUnnoticed) {
  const TestFolder folder;
  fill(folder);
  const auto path = folder.path() / Store::file_name;
  const auto sound = everything_in(folder.path());
  const auto size = fs::file_size(path);
  ASSERT_GE(size / page_size, 8U) << "leaves, an inner page and one for each table";
  unsigned noticed = 0, bit = 0;
  for (std::size_t at = 0; at < size;) {
    const auto in_page = at % page_size;
    {
      const Patch patch(path, at, static_cast<unsigned char>(1U << bit++ % 8));
      const auto found = read_or_refused(folder.path());
      EXPECT_TRUE(found.empty() || found == sound) << "byte " << at;
      noticed += found.empty();
    }
    at += in_page < 40 ? 1 : 263;  // heads of pages byte by byte
  }
  EXPECT_GT(noticed, 100U);
  EXPECT_EQ(everything_in(folder.path()), sound);
}

TEST(StoreDamage, AFlippedBitOfTheLogIsSaidAndItsUnfinishedEndIsNot) {
  const TestFolder folder, copy;
  auto store = begun(folder);
  for (std::uint32_t t = 0; t < 60; t += 10) store.write(rows_from(t, t + 10));
  const auto log = folder.read("store.db-wal");
  ASSERT_GT(log.size(), 5 * page_size);
  const auto with_log = [&](const std::string& bytes) {
    copy.write("store.db", folder.read("store.db"));
    copy.write("store.db-wal", bytes);
    fs::remove(copy.path() / "store.db-shm");
  };
  const auto trials_there = [&] {
    return Store::open(copy.path()).manifest().cells.at(0).finished;
  };
  with_log(log);
  EXPECT_EQ(trials_there(), 60U);
  with_log(log.substr(0, log.size() - 2 * page_size));
  EXPECT_LT(trials_there(), 60U) << "as a power cut leaves it";
  for (const auto at : {std::size_t{5}, log.size() / 3, log.size() / 2}) {
    auto flipped = log;
    flipped[at] ^= 4;
    with_log(flipped);
    EXPECT_THAT(trials_there, ThrowsMessage<StoreError>(AllOf(HasSubstr("store.db-wal: is damaged"),
                                                              HasSubstr("gyrostat repair"))))
        << at;
  }
}

TEST(StoreDamage, AStoreThatWasEmptiedOrRemovedIsNoNewBeginning) {
  const TestFolder folder;
  fill(folder);
  fs::resize_file(folder.path() / Store::file_name, 0);
  EXPECT_THAT([&] { Store::open(folder.path()); },
              ThrowsMessage<StoreError>(HasSubstr("is empty")));
  EXPECT_THAT([&] { begun(folder); }, ThrowsMessage<StoreError>(HasSubstr("is empty")));

  const TestFolder other;
  auto store = begun(other);
  store.write(rows_from(0, 10));
  fs::remove(other.path() / Store::file_name);
  EXPECT_THAT([&] { store.write(rows_from(10, 20)); },
              ThrowsMessage<StoreError>(HasSubstr("was removed or replaced")));
  EXPECT_THAT([&] { (void)store.manifest(); },
              ThrowsMessage<StoreError>(HasSubstr("was removed or replaced")));
}

TEST(StoreDamage, OfAShardIsSaidOfTheShardWhateverItsPath) {
  const TestFolder folder, sound;
  const TestFolder shard;
  fill(shard);
  const auto deep = folder.path() / std::string(200, 'a') / std::string(200, 'b');
  fs::create_directories(deep);
  auto bytes = shard.read("store.db");
  bytes.replace(bytes.size() - page_size, 8, "nonsense");
  shard.write("store.db", bytes);
  fs::copy_file(shard.path() / "store.db", deep / "store.db");
  auto target = begun(sound);
  for (const auto& from : {shard.path(), deep})
    EXPECT_THAT([&] { target.merge(from); },
                ThrowsMessage<StoreError>(AllOf(HasSubstr(from.string()), HasSubstr("is damaged"),
                                                Not(HasSubstr(sound.path().string())))));
  EXPECT_EQ(target.manifest().cells[0].finished, 0U);
}

TEST(StoreDamage, ARepairKeepsWhatIsSoundAndCountsTheRest) {
  const TestFolder folder;
  fill(folder);
  EXPECT_TRUE(Store::repair(folder.path()).is_sound());
  auto bytes = folder.read("store.db");
  const double marked = 300.25;  // of trial 300
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&marked), sizeof marked));
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at / page_size * page_size, 100, std::string(100, '\x55'));
  folder.write("store.db", bytes);
  EXPECT_EQ(read_or_refused(folder.path()), "");

  const auto repaired = Store::repair(folder.path());
  EXPECT_GT(repaired.dropped, 0);
  EXPECT_GT(repaired.kept, trials / 4);
  EXPECT_EQ(repaired.kept + repaired.dropped, trials + 1);
  EXPECT_EQ(folder.read(repaired.aside.value().filename().string()), bytes);
  EXPECT_NE(read_or_refused(folder.path()), "");

  fill(folder);  // what is missing is run again, what is there must be the same
  const TestFolder fresh;
  fill(fresh);
  std::vector<double> one, other;
  for (const auto& [path, values] : {std::pair(folder.path(), &one), {fresh.path(), &other}})
    Store::open(path).for_each_trial(0, trials, [&](const auto& trial) {
      values->insert(values->end(), trial.outcomes.begin(), trial.outcomes.end());
    });
  EXPECT_EQ(one, other);
}

}  // namespace
}  // namespace gyrostat::store_damage_test
