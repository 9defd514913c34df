#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace gyrostat::sqlite {

/// What SQLite could not do: its result code, the file and, on one line, the reason.
class Error : public std::runtime_error {
 public:
  Error(int code, std::filesystem::path path, const std::string& reason)
      : std::runtime_error(reason), code_(code), path_(std::move(path)) {}
  int code() const { return code_; }
  const std::filesystem::path& path() const { return path_; }
  /// Whether the file's contents, not its surroundings, are at fault.
  bool is_damage() const;

 private:
  int code_;
  std::filesystem::path path_;
};

class Database;

/// A prepared statement. Parameters count from 1, columns from 0; views end with the next `step`.
class Statement {
 public:
  Statement(Database& database, std::string_view sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(int parameter, std::int64_t value);
  void bind(int parameter, std::string_view value);
  /// The bytes are not copied: they must live until `reset` or the statement's end.
  void bind(int parameter, std::span<const std::byte> value);
  template <class... Values>
  Statement& with(const Values&... values) {
    int parameter = 0;
    (bind(++parameter, values), ...);
    return *this;
  }

  /// Goes to the next row; false behind the last.
  bool step();
  /// Runs a statement without rows to its end, and makes it ready to be run again.
  void run();
  void reset();

  std::int64_t integer(int column) const;
  std::string text(int column) const;
  std::span<const std::byte> blob(int column) const;

 private:
  Database& database_;
  sqlite3_stmt* statement_ = nullptr;
};

enum class Access { read, write };

/// A connection to one file.
class Database {
 public:
  Database(const std::filesystem::path& path, Access access);

  /// Runs statements that return nothing.
  void run(const std::string& sql);
  /// The single number that a query returns.
  std::int64_t number(std::string_view sql);
  std::string text(std::string_view sql);

  const std::filesystem::path& path() const { return path_; }
  sqlite3* get() const { return connection_.get(); }
  /// Throws Error with the connection's last message.
  [[noreturn]] void fail(int code) const;

 private:
  struct Close {
    void operator()(sqlite3* connection) const;
  };
  std::filesystem::path path_;
  std::unique_ptr<sqlite3, Close> connection_;
};

/// All or nothing: rolled back unless it was committed.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) {
    database_.run("BEGIN IMMEDIATE");
  }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace gyrostat::sqlite
