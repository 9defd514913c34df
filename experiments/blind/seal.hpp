#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gyrostat::gap {

/// Text that nobody reads or changes without its key: XSalsa20 and Poly1305, libsodium's
/// crypto_secretbox, behind the nonce. A key is 32 random bytes, written in hexadecimal digits.
std::string new_key();
std::string sealed(std::string_view text, const std::string& key);

/// The text again; InputError where the key is none, or another one, or the seal was tampered with.
std::string unsealed(std::string_view seal, const std::string& key, const std::string& place);

/// A number below 2^53 that nobody foretells.
std::uint64_t secret_seed();

}  // namespace gyrostat::gap
