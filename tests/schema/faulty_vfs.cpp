#include "tests/schema/faulty_vfs.h"

#include <sqlite3.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

namespace {

struct Undo {
  std::int64_t size_before;
  std::int64_t offset;
  std::string bytes_before;
};

struct State {
  sqlite3_vfs* system = nullptr;
  int calls_left = -1;  ///< until the fault; -1: none
  bool disk_full = false;
  bool for_good = false;
  bool fired = false;
  std::map<std::string, std::vector<Undo>> unsynced;
};
State state;

struct FaultyFile {
  sqlite3_file base;
  std::string* path;
  sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

FaultyFile* of(sqlite3_file* file) { return reinterpret_cast<FaultyFile*>(file); }

/// Whether this call is the one to fail.
bool fails(bool is_write = false) {
  if (state.calls_left < 0 || (state.disk_full && !is_write)) return false;
  if (state.calls_left > 0) {
    --state.calls_left;
    return false;
  }
  if (!state.for_good) state.calls_left = -1;
  state.fired = true;
  return true;
}

void remember(FaultyFile* file, std::int64_t offset, int amount) {
  if (file->path == nullptr) return;
  Undo undo{0, offset, {}};
  sqlite3_int64 size = 0;
  file->real()->pMethods->xFileSize(file->real(), &size);
  undo.size_before = size;
  const auto there = std::max<std::int64_t>(0, std::min<std::int64_t>(amount, size - offset));
  undo.bytes_before.resize(static_cast<std::size_t>(there));
  if (there > 0) {
    file->real()->pMethods->xRead(file->real(), undo.bytes_before.data(), static_cast<int>(there),
                                  offset);
  }
  state.unsynced[*file->path].push_back(undo);
}

int close_file(sqlite3_file* file) {
  const int code = of(file)->real()->pMethods->xClose(of(file)->real());
  delete of(file)->path;
  return code;
}
int read(sqlite3_file* file, void* into, int amount, sqlite3_int64 offset) {
  if (fails()) return SQLITE_IOERR_READ;
  return of(file)->real()->pMethods->xRead(of(file)->real(), into, amount, offset);
}
int write(sqlite3_file* file, const void* from, int amount, sqlite3_int64 offset) {
  if (fails(true)) return state.disk_full ? SQLITE_FULL : SQLITE_IOERR_WRITE;
  remember(of(file), offset, amount);
  return of(file)->real()->pMethods->xWrite(of(file)->real(), from, amount, offset);
}
int truncate_file(sqlite3_file* file, sqlite3_int64 size) {
  if (fails()) return SQLITE_IOERR_TRUNCATE;
  sqlite3_int64 now = 0;
  of(file)->real()->pMethods->xFileSize(of(file)->real(), &now);
  if (now > size) remember(of(file), size, static_cast<int>(now - size));
  return of(file)->real()->pMethods->xTruncate(of(file)->real(), size);
}
int sync(sqlite3_file* file, int flags) {
  if (fails()) return SQLITE_IOERR_FSYNC;
  if (of(file)->path != nullptr) state.unsynced.erase(*of(file)->path);
  return of(file)->real()->pMethods->xSync(of(file)->real(), flags);
}
int file_size(sqlite3_file* file, sqlite3_int64* size) {
  if (fails()) return SQLITE_IOERR_FSTAT;
  return of(file)->real()->pMethods->xFileSize(of(file)->real(), size);
}
int lock(sqlite3_file* file, int level) {
  return of(file)->real()->pMethods->xLock(of(file)->real(), level);
}
int unlock(sqlite3_file* file, int level) {
  return of(file)->real()->pMethods->xUnlock(of(file)->real(), level);
}
int check_reserved(sqlite3_file* file, int* out) {
  return of(file)->real()->pMethods->xCheckReservedLock(of(file)->real(), out);
}
int control(sqlite3_file* file, int op, void* argument) {
  return of(file)->real()->pMethods->xFileControl(of(file)->real(), op, argument);
}
int sector_size(sqlite3_file* file) {
  return of(file)->real()->pMethods->xSectorSize(of(file)->real());
}
int characteristics(sqlite3_file*) { return 0; }  // promises nothing that a power cut could break
int shm_map(sqlite3_file* file, int page, int size, int extend, void volatile** out) {
  if (fails()) return SQLITE_IOERR_SHMMAP;
  return of(file)->real()->pMethods->xShmMap(of(file)->real(), page, size, extend, out);
}
int shm_lock(sqlite3_file* file, int offset, int n, int flags) {
  return of(file)->real()->pMethods->xShmLock(of(file)->real(), offset, n, flags);
}
void shm_barrier(sqlite3_file* file) { of(file)->real()->pMethods->xShmBarrier(of(file)->real()); }
int shm_unmap(sqlite3_file* file, int remove) {
  return of(file)->real()->pMethods->xShmUnmap(of(file)->real(), remove);
}

const sqlite3_io_methods methods{2,
                                 close_file,
                                 read,
                                 write,
                                 truncate_file,
                                 sync,
                                 file_size,
                                 lock,
                                 unlock,
                                 check_reserved,
                                 control,
                                 sector_size,
                                 characteristics,
                                 shm_map,
                                 shm_lock,
                                 shm_barrier,
                                 shm_unmap,
                                 nullptr,
                                 nullptr};

int open_file(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  file->pMethods = nullptr;
  if (fails()) return SQLITE_CANTOPEN;
  FaultyFile* faulty = of(file);
  const int code = state.system->xOpen(state.system, name, faulty->real(), flags, out_flags);
  if (code != SQLITE_OK) return code;
  faulty->path = name == nullptr ? nullptr : new std::string(name);
  faulty->base.pMethods = &methods;
  return SQLITE_OK;
}
int delete_file(sqlite3_vfs*, const char* name, int sync_folder) {
  if (fails()) return SQLITE_IOERR_DELETE;
  return state.system->xDelete(state.system, name, sync_folder);
}

sqlite3_vfs layer;

}  // namespace

FaultyVfs::FaultyVfs() {
  state = State{};
  state.system = sqlite3_vfs_find(nullptr);
  layer = *state.system;
  layer.pNext = nullptr;
  layer.zName = "faulty";
  layer.szOsFile = static_cast<int>(sizeof(FaultyFile)) + state.system->szOsFile;
  layer.xOpen = open_file;
  layer.xDelete = delete_file;
  REQUIRE(sqlite3_vfs_register(&layer, 1) == SQLITE_OK);
}

FaultyVfs::~FaultyVfs() {
  sqlite3_vfs_unregister(&layer);
  sqlite3_vfs_register(state.system, 1);
}

void FaultyVfs::fail_call(int n, Kind kind, bool for_good) {
  state.calls_left = n;
  state.disk_full = kind == Kind::disk_full;
  state.for_good = for_good;
  state.fired = false;
}

void FaultyVfs::fail_nothing() { state.calls_left = -1; }

bool FaultyVfs::fired() const { return state.fired; }

void FaultyVfs::power_cut(const std::string& database) {
  for (auto& [path, undos] : state.unsynced) {
    if (!std::filesystem::exists(path)) continue;
    for (auto undo = undos.rbegin(); undo != undos.rend(); ++undo) {
      std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(undo->offset);
      file.write(undo->bytes_before.data(),
                 static_cast<std::streamsize>(undo->bytes_before.size()));
      file.close();
      std::filesystem::resize_file(path, static_cast<std::uintmax_t>(undo->size_before));
    }
  }
  state.unsynced.clear();
  std::filesystem::remove(database + "-shm");  // memory only
}
