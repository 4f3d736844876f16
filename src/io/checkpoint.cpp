// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/io/checkpoint.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/output_file.hpp"
#include "perimode/core/error.hpp"

namespace perimode {

namespace fs = std::filesystem;

namespace {

// A checkpoint is an HDF5 file with a user block of 512 bytes, which HDF5 passes over:
//   perimode checkpoint / format 2 / xxh3-128 <checksum of the file with zeros in its place> / zero bytes
constexpr int format = 2;
constexpr std::string_view magic = "perimode checkpoint\nformat ";
constexpr std::size_t header_bytes = 512;
constexpr std::string_view no_sum = "00000000000000000000000000000000";

constexpr const char* latest_name = "checkpoint.h5";
constexpr const char* previous_name = "checkpoint.previous.h5";
constexpr const char* aside_name = "checkpoint.h5.new";
constexpr const char* damaged_name = "checkpoint.damaged.h5";

/// XXH3 over pieces.
class Hash {
 public:
  Hash() { XXH3_128bits_reset(&state_); }
  void add(std::string_view bytes) { XXH3_128bits_update(&state_, bytes.data(), bytes.size()); }
  [[nodiscard]] std::string text() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(&state_);
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
  }

 private:
  XXH3_state_t state_;
};

std::string header_text(int version, std::string_view sum) {
  std::string text = fmt::format("{}{}\nxxh3-128 {}\n", magic, version, sum);
  text.resize(header_bytes, '\0');
  return text;
}

/// An HDF5 object that is closed with its scope. A negative id is a failure of the library.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw Error(ErrorKind::environment, "HDF5 could not open an object of a checkpoint");
  }
  ~Handle() { (void)close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): as the C functions take it

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void check(herr_t status) {
  if (status < 0) throw Error(ErrorKind::environment, "HDF5 could not work on a checkpoint");
}

/// HDF5 prints no errors of its own meanwhile.
class SilentHdf5 {
 public:
  SilentHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~SilentHdf5() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  SilentHdf5(const SilentHdf5&) = delete;
  SilentHdf5& operator=(const SilentHdf5&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// All of HDF5 happens in memory: what it would make of a full disk or of damaged bytes is never met.
constexpr std::size_t memory_step = 1U << 20U;

template <class T>
hid_t type_of();
template <>
hid_t type_of<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t type_of<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t type_of<std::uint64_t>() {
  return H5T_NATIVE_UINT64;
}

void put_attribute(hid_t file, const char* name, std::span<const std::int64_t> values) {
  const hsize_t size = values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Handle attribute(H5Acreate2(file, name, H5T_NATIVE_INT64, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  check(H5Awrite(attribute, H5T_NATIVE_INT64, values.data()));
}

void get_attribute(hid_t file, const char* name, std::span<std::int64_t> values) {
  const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(values.size())) check(-1);
  check(H5Aread(attribute, H5T_NATIVE_INT64, values.data()));
}

template <class T>
void put_arrays(hid_t file, const char* group_name, const std::map<std::string, std::vector<T>>& arrays) {
  const Handle group(H5Gcreate2(file, group_name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  for (const auto& [name, values] : arrays) {
    const hsize_t size = values.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Handle data(
        H5Dcreate2(group, name.c_str(), type_of<T>(), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose);
    if (size > 0) check(H5Dwrite(data, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  }
}

template <class T>
void get_arrays(hid_t file, const char* group_name, std::map<std::string, std::vector<T>>& arrays) {
  const Handle group(H5Gopen2(file, group_name, H5P_DEFAULT), H5Gclose);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  hsize_t from = 0;
  check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, &from, collect, &names));
  for (const std::string& name : names) {
    const Handle data(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle space(H5Dget_space(data), H5Sclose);
    std::vector<T>& values = arrays[name];
    values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    if (!values.empty()) check(H5Dread(data, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  }
}

/// A number for each name, as the arrays of one number that the file holds.
std::map<std::string, std::vector<std::int64_t>> arrays_of(
    const std::map<std::string, std::int64_t>& numbers) {
  std::map<std::string, std::vector<std::int64_t>> arrays;
  for (const auto& [name, number] : numbers) arrays[name] = {number};
  return arrays;
}

/// The bytes of an HDF5 file that holds the checkpoint.
std::string encode(const Checkpoint& checkpoint) {
  const SilentHdf5 silent;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  check(H5Pset_fapl_core(access, memory_step, 0));
  const Handle file(H5Fcreate(latest_name, H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  const std::array<std::int64_t, 2> counters = {checkpoint.state.step, checkpoint.frames};
  put_attribute(file, "step, frames", counters);
  {
    const Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
    check(H5Tset_size(text, checkpoint.case_digest.size() + 1));
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(file, "case_digest", text, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check(H5Awrite(attribute, text, checkpoint.case_digest.c_str()));
  }
  put_arrays(file, "bytes", arrays_of(checkpoint.bytes));
  put_arrays(file, "numbers", checkpoint.state.numbers);
  put_arrays(file, "bits", checkpoint.state.bits);
  check(H5Fflush(file, H5F_SCOPE_GLOBAL));
  std::string image(static_cast<std::size_t>(H5Fget_file_image(file, nullptr, 0)), '\0');
  if (H5Fget_file_image(file, image.data(), image.size()) < 0) check(-1);
  return image;
}

Checkpoint decode(std::string& image) {
  const SilentHdf5 silent;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  check(H5Pset_fapl_core(access, memory_step, 0));
  check(H5Pset_file_image(access, image.data(), image.size()));
  const Handle file(H5Fopen(latest_name, H5F_ACC_RDONLY, access), H5Fclose);
  Checkpoint checkpoint;
  std::array<std::int64_t, 2> counters = {};
  get_attribute(file, "step, frames", counters);
  checkpoint.state.step = counters[0];
  checkpoint.frames = counters[1];
  {
    const Handle attribute(H5Aopen(file, "case_digest", H5P_DEFAULT), H5Aclose);
    const Handle text(H5Aget_type(attribute), H5Tclose);
    checkpoint.case_digest.resize(H5Tget_size(text));
    check(H5Aread(attribute, text, checkpoint.case_digest.data()));
    checkpoint.case_digest.pop_back();
  }
  std::map<std::string, std::vector<std::int64_t>> bytes;
  get_arrays(file, "bytes", bytes);
  for (const auto& [name, number] : bytes) checkpoint.bytes[name] = number.at(0);
  get_arrays(file, "numbers", checkpoint.state.numbers);
  get_arrays(file, "bits", checkpoint.state.bits);
  return checkpoint;
}

/// All bytes of a file; none if it is not there.
std::optional<std::string> content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::string bytes(std::istreambuf_iterator<char>(stream), {});
  if (stream.bad()) return std::nullopt;
  return bytes;
}

/// The format of a whole checkpoint, from its bytes; none for one that is not whole.
std::optional<int> whole_format(std::string& bytes) {
  if (bytes.size() < header_bytes || !bytes.starts_with(magic)) return std::nullopt;
  const std::string_view line = "\nxxh3-128 ";
  const std::size_t found = std::string_view(bytes).substr(0, header_bytes).find(line, magic.size());
  if (found == std::string::npos || found + line.size() + no_sum.size() > header_bytes) return std::nullopt;
  const std::size_t place = found + line.size();
  const std::string sum = bytes.substr(place, no_sum.size());
  bytes.replace(place, no_sum.size(), no_sum);
  Hash hash;
  hash.add(bytes);
  if (hash.text() != sum) return std::nullopt;
  return std::stoi(bytes.substr(magic.size(), found - magic.size()));
}

[[noreturn]] void fail(const char* expected, const fs::path& file, const std::error_code& reason) {
  throw Error(
      ErrorKind::environment,
      Complaint{expected, reason.message(), "check the free space and the permissions", {file.string()}});
}

void rename_in(const fs::path& folder, const char* from, const char* to) {
  std::error_code failed;
  fs::rename(folder / from, folder / to, failed);
  if (failed) fail("to rename a checkpoint", folder / from, failed);
}

}  // namespace

std::string case_digest(const std::string& analysis, const std::string& canonical,
                        const std::vector<fs::path>& files) {
  Hash hash;
  const auto add = [&hash](std::string_view part) {
    hash.add(fmt::format("{}\n", part.size()));  // where parts end counts
    hash.add(part);
  };
  add(fmt::format("format {}", format));
  add(analysis);
  add(canonical);
  for (const fs::path& file : files) {
    const std::optional<std::string> bytes = content(file);
    if (!bytes) {
      throw Error(ErrorKind::environment, Complaint{"to read a file of the case",
                                                    "a failure",
                                                    "check that it is there and may be read",
                                                    {file.string()}});
    }
    add(*bytes);
  }
  return hash.text();
}

void write_checkpoint(const fs::path& folder, const Checkpoint& checkpoint) {
  const std::string image = encode(checkpoint);
  Hash hash;
  hash.add(header_text(format, no_sum));
  hash.add(image);
  try {
    OutputFile output(folder / aside_name);
    output.write(header_text(format, hash.text()));
    output.write(image);
    output.sync();
    output.close();
  } catch (...) {
    std::error_code ignored;
    fs::remove(folder / aside_name, ignored);
    throw;
  }
  if (fs::exists(folder / latest_name)) rename_in(folder, latest_name, previous_name);
  rename_in(folder, aside_name, latest_name);
  sync_folder(folder);
}

std::optional<Checkpoint> read_checkpoint(const fs::path& folder, const std::string& case_digest,
                                          const Sink& sink) {
  std::string damaged;
  for (const char* name : {latest_name, previous_name}) {
    const fs::path file = folder / name;
    if (!fs::exists(file)) continue;
    std::optional<std::string> bytes = content(file);
    const std::optional<int> version = bytes ? whole_format(*bytes) : std::nullopt;
    if (!version) {
      if (!damaged.empty()) damaged += ", ";
      damaged += file.string();
      continue;
    }
    if (*version != format) {
      invalid_input({fmt::format("a checkpoint of format {}", format),
                     fmt::format("one of format {}", *version),
                     "go on with the version of perimode that wrote it, or start anew with --force",
                     {file.string()}});
    }
    bytes->erase(0, header_bytes);
    Checkpoint checkpoint = decode(*bytes);
    if (checkpoint.case_digest != case_digest) {
      invalid_input(
          {"a checkpoint of this case",
           "one of another case or analysis, or of this one before it or a file it names was changed",
           "go on with the case as it was, start anew with --force, or give another --output",
           {file.string()}});
    }
    if (!damaged.empty()) {
      sink.warn(fmt::format("{} is damaged; going on from the checkpoint before", damaged));
      std::error_code ignored;  // else the next checkpoint would be followed by a damaged one
      fs::rename(folder / latest_name, folder / damaged_name, ignored);
    }
    return checkpoint;
  }
  if (damaged.empty()) return std::nullopt;
  invalid_input(
      {"a checkpoint that is whole", "truncated or damaged ones only", "start anew with --force", {damaged}});
}

bool has_checkpoint(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / latest_name, ignored) || fs::exists(folder / previous_name, ignored);
}

void remove_checkpoints(const fs::path& folder) noexcept {
  std::error_code ignored;
  for (const char* name : {latest_name, previous_name, aside_name, damaged_name})
    fs::remove(folder / name, ignored);
}

}  // namespace perimode
