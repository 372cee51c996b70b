// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/file/doing.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace nvm::io {

namespace {

/// The most that the process has had in memory [bytes].
double peak_memory() {
#ifdef __APPLE__
  constexpr double kUnit = 1.0;
#else
  constexpr double kUnit = 1024.0;
#endif
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  return kUnit * static_cast<double>(usage.ru_maxrss);
}

/// What it may have [bytes]: the machine's memory, or the limit that was set for it.
double memory_limit() {
  const double machine =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  struct rlimit limit {};
  return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY
             ? std::min(machine, static_cast<double>(limit.rlim_cur))
             : machine;
}

}  // namespace

std::string out_of_memory(const std::string& what) {
  return fmt::format(
      "memory ran out while {}: {:.0f} MB were in use and more than the {:.0f} MB that there are "
      "were asked for (see \"memory\" in docs/troubleshooting.md)",
      what,
      peak_memory() / kBytesPerMegabyte,
      memory_limit() / kBytesPerMegabyte);
}

std::string file_trouble(const std::string& what, const std::filesystem::filesystem_error& error) {
  return fmt::format(
      "while {}: {}: {}",
      what,
      error.path1().empty() ? "file system" : error.path1().string(),
      error.code().message());
}

}  // namespace nvm::io
