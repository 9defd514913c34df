#include <gyrostat/results/store_log.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <thread>
#include <vector>

namespace gyrostat {
namespace {

constexpr std::size_t head_size = 32, frame_head_size = 24;
using Sums = std::array<std::uint32_t, 2>;
using Head = std::array<unsigned char, head_size>;

std::uint32_t big_endian(const unsigned char* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
         std::uint32_t{bytes[2]} << 8 | bytes[3];
}

std::uint32_t little_endian(const unsigned char* bytes) {
  return std::uint32_t{bytes[3]} << 24 | std::uint32_t{bytes[2]} << 16 |
         std::uint32_t{bytes[1]} << 8 | bytes[0];
}

Sums stored_sums(const unsigned char* bytes) { return {big_endian(bytes), big_endian(bytes + 4)}; }

/// Continues the sums over bytes, whose number is a multiple of eight.
Sums continued(Sums s, const unsigned char* bytes, std::size_t size, bool in_big_endian) {
  const auto word = in_big_endian ? big_endian : little_endian;
  for (std::size_t i = 0; i < size; i += 8) {
    s[0] += word(bytes + i) + s[1];
    s[1] += word(bytes + i + 4) + s[0];
  }
  return s;
}

std::optional<std::uint64_t> look_at(const std::filesystem::path& log) {
  std::ifstream file(log, std::ios::binary);
  Head head{};
  if (!file.read(reinterpret_cast<char*>(head.data()), head_size)) return std::nullopt;
  if (std::ranges::all_of(head, [](auto byte) { return byte == 0; })) return std::nullopt;
  const auto magic = big_endian(head.data());
  const bool in_big_endian = magic == 0x377f0683;
  const auto page_size = big_endian(head.data() + 8);
  const auto sums = stored_sums(head.data() + 24);
  const bool is_sound = (in_big_endian || magic == 0x377f0682) && page_size >= 512 &&
                        page_size <= 65536 && continued({}, head.data(), 24, in_big_endian) == sums;
  if (!is_sound) return file.peek() == EOF ? std::nullopt : std::optional<std::uint64_t>{0};

  // A frame is sound where its sums go on from those that stand in the one before. After one that
  // is not, SQLite reads no more; that there is another sound commit tells damage from an end.
  std::optional<std::uint64_t> broken_at;
  std::vector<unsigned char> frame(frame_head_size + page_size);
  Sums before = sums;
  for (std::uint64_t at = head_size;
       file.read(reinterpret_cast<char*>(frame.data()), static_cast<std::streamsize>(frame.size()));
       at += frame.size()) {
    const auto stated = stored_sums(frame.data() + 16);
    const bool is_of_this_log = std::equal(head.begin() + 16, head.begin() + 24, &frame[8]);
    const auto actual = continued(continued(before, frame.data(), 8, in_big_endian),
                                  frame.data() + frame_head_size, page_size, in_big_endian);
    const bool holds = is_of_this_log && actual == stated;
    const bool is_commit = big_endian(frame.data() + 4) != 0;
    if (broken_at && holds && is_commit) return broken_at;
    if (!broken_at && !holds) broken_at = at;
    before = stated;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::uint64_t> damage_of_log(const std::filesystem::path& database) {
  const std::filesystem::path log = database.string() + "-wal";
  // Who writes while this reads makes a log look torn for a moment: only what stays is damage.
  constexpr int looks = 4;
  auto first = look_at(log);
  for (int i = 1; first && i < looks; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    if (look_at(log) != first) return std::nullopt;
  }
  return first;
}

}  // namespace gyrostat
