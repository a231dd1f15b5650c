#pragma once

#include <string>

/// SQLite's file layer with faults, between it and the system's. While one exists it is the layer
/// every new connection uses.
class FaultyVfs {
 public:
  FaultyVfs();
  ~FaultyVfs();
  FaultyVfs(const FaultyVfs&) = delete;
  FaultyVfs& operator=(const FaultyVfs&) = delete;

  enum class Kind { io_error, disk_full };
  /// The n-th call from now that could fail (open, read, write, sync, truncate, size, delete,
  /// shared memory) does, once or from then on for good. With disk_full only writes count.
  void fail_call(int n, Kind kind, bool for_good);
  void fail_nothing();
  /// Whether the fault has come about since fail_call().
  [[nodiscard]] bool fired() const;
  /// As if the power had gone: what was written and not synced since is undone. Close nothing
  /// before: a closing connection would write.
  void power_cut(const std::string& database);
};
