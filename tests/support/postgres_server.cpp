#include "support/postgres_server.hpp"
#include "support/places.hpp"

#include <fcntl.h>
#include <libpq-fe.h>
#include <netinet/in.h>
#include <pwd.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace ream::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* user = "ream";

/// Of the newest PostgreSQL that is installed.
fs::path program(const std::string& name) {
  std::vector<fs::path> versions;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator("/usr/lib/postgresql", failed))
    versions.push_back(entry.path());
  std::sort(versions.begin(), versions.end());
  if (versions.empty()) throw std::runtime_error("tests need PostgreSQL; scripts/setup installs it");
  return versions.back() / "bin" / name;
}

/// Who runs the server: PostgreSQL refuses root.
const passwd* unprivileged_user() {
  if (::geteuid() != 0) return nullptr;
  const passwd* found = ::getpwnam("postgres");
  return found != nullptr ? found : ::getpwnam("nobody");
}

/// Starts a program that dies with this process. Its output goes to `log`.
pid_t start_program(std::vector<std::string> command, const fs::path& log) {
  const passwd* other = unprivileged_user();
  std::vector<char*> words;
  for (std::string& word : command) words.push_back(word.data());
  words.push_back(nullptr);
  char locale[] = "LC_ALL=C.UTF-8";
  char* const environment[] = {locale, nullptr};
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  const bool changed = other == nullptr || (::setgid(other->pw_gid) == 0 && ::setuid(other->pw_uid) == 0);
  ::prctl(PR_SET_PDEATHSIG, SIGQUIT);
  if (changed && ::dup2(out, 1) == 1 && ::dup2(out, 2) == 2 && ::chdir("/") == 0)
    ::execve(words[0], words.data(), environment);
  ::_exit(127);
}

void run_program(const std::vector<std::string>& command, const fs::path& log) {
  const pid_t child = start_program(command, log);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (status != 0) throw std::runtime_error(command[0] + " failed; see " + log.string());
}

/// Every file belongs to the user who runs the server.
void give_away(const fs::path& folder) {
  const passwd* other = unprivileged_user();
  if (other == nullptr) return;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (::chown(entry.path().c_str(), other->pw_uid, other->pw_gid) != 0)
      throw std::runtime_error("cannot give away " + entry.path().string());
  if (::chown(folder.c_str(), other->pw_uid, other->pw_gid) != 0)
    throw std::runtime_error("cannot give away " + folder.string());
}

/// An empty cluster: a copy of the one that the first test of this build has made, which is quicker.
void make_cluster(const fs::path& data, const fs::path& log) {
  const fs::path first = fs::path(build_folder()) /
                         ("postgresql-" + program("initdb").parent_path().parent_path().filename().string());
  if (fs::exists(first)) {
    fs::copy(first, data, fs::copy_options::recursive);
    fs::permissions(data, fs::perms::owner_all);
    return give_away(data);
  }
  run_program({program("initdb"), "-D", data, "-U", user, "-A", "trust", "-E", "UTF8", "--no-sync",
               "--no-instructions"},
              log);
  const fs::path copy = first.string() + "." + std::to_string(::getpid()) + ".tmp";
  fs::copy(data, copy, fs::copy_options::recursive);
  std::error_code another_was_quicker;
  fs::rename(copy, first, another_was_quicker);
  if (another_was_quicker) fs::remove_all(copy);
}

uint16_t free_port() {
  const int probe = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  ::bind(probe, reinterpret_cast<sockaddr*>(&address), sizeof address);
  ::getsockname(probe, reinterpret_cast<sockaddr*>(&address), &length);
  ::close(probe);
  return ntohs(address.sin_port);
}

using Connection = std::unique_ptr<PGconn, decltype(&PQfinish)>;

std::string url_of(uint16_t port, const std::string& database) {
  return "postgresql://" + std::string(user) + "@127.0.0.1:" + std::to_string(port) + "/" + database;
}

}  // namespace

PostgresServer::PostgresServer() : port_(free_port()) {
  std::string name = "/tmp/ream-postgres-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  folder_ = name;
  if (const passwd* other = unprivileged_user();
      other != nullptr && ::chown(folder_.c_str(), other->pw_uid, other->pw_gid) != 0)
    throw std::runtime_error("cannot give away " + folder_.string());
  make_cluster(folder_ / "data", folder_ / "log");
  start();
}

PostgresServer::~PostgresServer() {
  stop();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

PostgresServer& PostgresServer::shared() {
  static PostgresServer server;
  return server;
}

void PostgresServer::start() {
  process_ = start_program({program("postgres"), "-D", folder_ / "data", "-p", std::to_string(port_), "-h",
                            "127.0.0.1", "-k", folder_, "-c", "fsync=off", "-c", "full_page_writes=off", "-c",
                            "max_connections=50", "-c", "shared_buffers=32MB"},
                           folder_ / "log");
  const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (::PQping(url_of(port_, "postgres").c_str()) != PQPING_OK) {
    if (::waitpid(process_, nullptr, WNOHANG) != 0 || std::chrono::steady_clock::now() > latest)
      throw std::runtime_error("PostgreSQL did not start; see " + (folder_ / "log").string());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void PostgresServer::stop() {
  if (process_ < 0) return;
  go_on();
  ::kill(process_, SIGQUIT);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

void PostgresServer::hang() {
  const Connection connection(::PQconnectdb(url_of(port_, "postgres").c_str()), &PQfinish);
  PGresult* const found = ::PQexec(connection.get(), "SELECT pid FROM pg_stat_activity");
  for (int row = 0; row < ::PQntuples(found); ++row)
    hanging_.push_back(std::stoi(::PQgetvalue(found, row, 0)));
  ::PQclear(found);
  hanging_.push_back(process_);
  for (const int process : hanging_) ::kill(process, SIGSTOP);
}

void PostgresServer::go_on() {
  for (const int process : hanging_) ::kill(process, SIGCONT);
  hanging_.clear();
}

std::string PostgresServer::make_database() {
  const std::string name = "test" + std::to_string(++databases_);
  const Connection connection(::PQconnectdb(url_of(port_, "postgres").c_str()), &PQfinish);
  const std::string statement = "CREATE DATABASE " + name;
  PGresult* const made = ::PQexec(connection.get(), statement.c_str());
  const bool done = ::PQresultStatus(made) == PGRES_COMMAND_OK;
  ::PQclear(made);
  if (!done) throw std::runtime_error(std::string("no test database: ") + ::PQerrorMessage(connection.get()));
  return url_of(port_, name);
}

}  // namespace ream::test
