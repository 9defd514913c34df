#include <gyrostat/experiments/blind/seal.hpp>

#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <sodium.h>

#include <gyrostat/core/error.hpp>

namespace gyrostat::gap {
namespace {

using Key = std::array<unsigned char, crypto_secretbox_KEYBYTES>;

void start_sodium() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium does not start");
}

unsigned char* bytes(std::string& text) { return reinterpret_cast<unsigned char*>(text.data()); }
const unsigned char* bytes(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

Key key_in(const std::string& text) {
  Key key{};
  std::size_t length = 0;
  const char* end = nullptr;
  sodium_hex2bin(key.data(), key.size(), text.data(), text.size(), nullptr, &length, &end);
  if (length != key.size() || end != text.data() + text.size())
    throw InputError("--key", fmt::format("'{}' is no key; a key is {} hexadecimal digits", text,
                                          2 * key.size()));
  return key;
}

}  // namespace

std::string new_key() {
  start_sodium();
  Key key{};
  randombytes_buf(key.data(), key.size());
  std::string text(2 * key.size() + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), key.data(), key.size());
  text.pop_back();
  return text;
}

std::string sealed(std::string_view text, const std::string& key) {
  start_sodium();
  std::string nonce(crypto_secretbox_NONCEBYTES, '\0');
  randombytes_buf(nonce.data(), nonce.size());
  std::string box(crypto_secretbox_MACBYTES + text.size(), '\0');
  crypto_secretbox_easy(bytes(box), bytes(text), text.size(), bytes(nonce), key_in(key).data());
  return nonce + box;
}

std::string unsealed(std::string_view seal, const std::string& key, const std::string& place) {
  start_sodium();
  const auto bytes_of_key = key_in(key);
  constexpr std::size_t before = crypto_secretbox_NONCEBYTES,
                        least = before + crypto_secretbox_MACBYTES;
  if (seal.size() < least)
    throw InputError(place,
                     fmt::format("{} bytes are no seal; allowed: {} or more", seal.size(), least));
  const auto box = seal.substr(before);
  std::string text(box.size() - crypto_secretbox_MACBYTES, '\0');
  if (crypto_secretbox_open_easy(bytes(text), bytes(box), box.size(), bytes(seal),
                                 bytes_of_key.data()) != 0)
    throw InputError(place, "the key does not open it: it is another's, or the file was changed");
  return text;
}

std::uint64_t secret_seed() {
  start_sodium();
  std::uint64_t seed = 0;
  randombytes_buf(&seed, sizeof seed);
  return seed >> 11;
}

}  // namespace gyrostat::gap
