#include "fpz/point/failure_capture.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <system_error>

#include "fpz/capture.hpp"

namespace fpz::point {

namespace {

std::mutex folder_guard;
std::atomic<int> written{0};

std::string& chosen_folder() {
  static std::string folder;
  return folder;
}

std::filesystem::path folder() {
  const std::lock_guard lock(folder_guard);
  if (!chosen_folder().empty()) return chosen_folder();
  const char* asked = std::getenv(capture_variable);
  return asked != nullptr ? asked : "";
}

/// Unique among the processes that may share a folder, on one machine or several.
std::string process_name() {
  std::array<char, 65> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  return std::string(host.data()) + "-" + std::to_string(::getpid());
}

}  // namespace

void set_capture_folder(const std::string& folder) {
  const std::lock_guard lock(folder_guard);
  chosen_folder() = folder;
  written = 0;
}

template <int Dim>
std::string capture_failure(const Behaviour& behaviour, const State<double, Dim>& begin,
                            const Tensor<double, Dim>& strain_increment, Status status) {
  const std::filesystem::path where = folder();
  if (where.empty()) return {};
  const int number = ++written;
  if (number > most_captures) {
    written = most_captures;
    return "not captured: " + std::to_string(most_captures) + " failures of this process have been";
  }
  std::error_code failed;
  std::filesystem::create_directories(where, failed);
  const std::string stem = "fpz-" + process_name() + "-" + std::to_string(number);
  std::filesystem::path file = where / (stem + ".json");
  for (int k = 2; std::filesystem::exists(file, failed); ++k) {  // of an earlier process with this number
    file = where / (stem + "-" + std::to_string(k) + ".json");
  }
  const Capture<Dim> capture{
      behaviour.parameters, behaviour.setting, behaviour.options, begin, strain_increment, status};
  if (!write_capture<Dim>(file, capture)) return "cannot be captured: " + file.string() + " cannot be written";
  return "captured: fpz-driver replay " + file.string();
}

template std::string capture_failure<2>(const Behaviour&, const State<double, 2>&, const Tensor<double, 2>&, Status);
template std::string capture_failure<3>(const Behaviour&, const State<double, 3>&, const Tensor<double, 3>&, Status);

}  // namespace fpz::point
