#include "workup/upload_store.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/new_id.hpp"
#include "core/temporary_file.hpp"
#include "net/problem.hpp"

namespace ream::workup {
namespace fs = std::filesystem;
namespace {

constexpr std::array endings{".zip", ".nrrd", ".nii", ".nii.gz", ".mha", ".txt", ".dcm"};

void check_name(const std::string& name) {
  const auto refuse = [&](const std::string& why) {
    throw net::RequestError(422, "the upload cannot be used: 'name' " + why, {{"#/name", why}});
  };
  if (name.empty() || name.size() > max_upload_name)
    refuse("must be 1 to " + std::to_string(max_upload_name) + " characters long");
  if (name.front() == '.' || name.find_first_of("/\\") != std::string::npos ||
      std::any_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
    refuse("must be a plain file name");
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (std::none_of(endings.begin(), endings.end(), [&](const char* end) { return lower.ends_with(end); }))
    refuse("must end in .zip, .nrrd, .nii, .nii.gz, .mha, .txt or .dcm");
}

}  // namespace

UploadStore::UploadStore(fs::path folder, UploadLimits limits) : folder_(std::move(folder)), limits_(limits) {
  if (!folder_.empty()) remove_tree(folder_);
}

fs::path UploadStore::file_of(const Upload& upload) const { return folder_ / upload.id / upload.name; }

UploadStore::Entry& UploadStore::find(const std::string& id) {
  const auto found = uploads_.find(id);
  if (found == uploads_.end())
    throw Error(ErrorKind::not_found, "no upload '" + id + "'; begin one with POST /api/v1/uploads");
  return found->second;
}

Upload UploadStore::create(const std::string& name, uint64_t bytes, const std::string& owner) {
  check_name(name);
  const std::lock_guard lock(mutex_);
  uint64_t announced = 0;
  for (const auto& [id, entry] : uploads_) announced += entry.upload.bytes;
  if (bytes > limits_.file_bytes)
    throw net::RequestError(413, "'" + name + "' is larger than a file may be, " +
                                     std::to_string(limits_.file_bytes >> 20) + " MiB");
  if (announced + bytes > limits_.all_bytes || uploads_.size() >= limits_.count)
    throw net::RequestError(413,
                            "too many uploads wait to be used; delete one (DELETE /api/v1/uploads/{id})");
  Upload upload{random_id(), name, bytes, 0, owner};
  make_writable_folder(folder_ / upload.id);
  if (!std::ofstream(file_of(upload), std::ios::binary))
    throw Error(ErrorKind::io, "cannot write " + file_of(upload).string());
  uploads_[upload.id] = {upload, Clock::now()};
  return upload;
}

Upload UploadStore::get(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  return const_cast<UploadStore*>(this)->find(id).upload;
}

std::vector<Upload> UploadStore::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<Upload> all;
  for (const auto& [id, entry] : uploads_) all.push_back(entry.upload);
  return all;
}

Upload UploadStore::append(const std::string& id, uint64_t offset, std::string_view piece) {
  const std::lock_guard lock(mutex_);
  Entry& entry = find(id);
  Upload& upload = entry.upload;
  if (offset != upload.received)
    throw Error(ErrorKind::conflict, "the piece begins at " + std::to_string(offset) + ", but " +
                                         std::to_string(upload.received) +
                                         " bytes have come; go on from there");
  if (offset + piece.size() > upload.bytes)
    throw Error(ErrorKind::conflict, "the piece goes beyond the " + std::to_string(upload.bytes) +
                                         " bytes that were announced for upload '" + id + "'");
  std::fstream file(file_of(upload), std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(static_cast<std::streamoff>(offset));
  file.write(piece.data(), static_cast<std::streamsize>(piece.size()));
  file.close();
  if (!file) throw Error(ErrorKind::io, "cannot write " + file_of(upload).string() + "; is the disk full?");
  upload.received += piece.size();
  entry.used = Clock::now();
  return upload;
}

void UploadStore::remove(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const Upload upload = find(id).upload;
  uploads_.erase(id);
  remove_tree(folder_ / upload.id);
}

fs::path UploadStore::take(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const Upload upload = find(id).upload;
  if (upload.received != upload.bytes)
    throw Error(ErrorKind::conflict, "upload '" + id +
                                         "' is not complete: " + std::to_string(upload.received) + " of " +
                                         std::to_string(upload.bytes) + " bytes have come");
  uploads_.erase(id);
  return file_of(upload);
}

void UploadStore::remove_idle(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  std::erase_if(uploads_, [&](const auto& held) {
    const Entry& entry = held.second;
    if (now - entry.used < limits_.idle) return false;
    remove_tree(folder_ / entry.upload.id);
    return true;
  });
}

}  // namespace ream::workup
