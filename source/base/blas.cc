#include "stockwork/base/blas.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace stockwork
{
namespace
{
/// File name of the shared library that a loaded function lives in, links followed.
std::string library_of(void *function)
{
  Dl_info info;
  if (function == nullptr || dladdr(function, &info) == 0 || info.dli_fname == nullptr)
    return "";
  std::error_code error;
  const auto path = std::filesystem::canonical(info.dli_fname, error);
  return error ? info.dli_fname : path.string();
}

/// A function of a library that may not be there; null: it is not.
template <class Function>
Function *loaded(const char *name)
{
  return reinterpret_cast<Function *>(dlsym(RTLD_DEFAULT, name));
}

/// Which processor OpenBLAS's routines are for; empty: it is not OpenBLAS.
std::string openblas_processor()
{
  auto *const name = loaded<char *()>("openblas_get_corename");
  return name != nullptr ? name() : "";
}

/// The newest processor that OpenBLAS 0.3.21 has routines for which run on this one, without those
/// for half precision; null: none that is better than the oldest.
const char *known_relative()
{
#if defined(__x86_64__)
  const auto all = [](const auto... has) { return (has && ...); };
  if (all(__builtin_cpu_supports("avx512f"), __builtin_cpu_supports("avx512bw"),
          __builtin_cpu_supports("avx512dq"), __builtin_cpu_supports("avx512vl")))
    return "SkylakeX";
  if (all(__builtin_cpu_supports("avx2"), __builtin_cpu_supports("fma")))
    return "Haswell";
#endif
  return nullptr;
}

struct Blas
{
  std::string name;
  bool slow = false;
};

/// The function that a call of dgemm reaches tells the library; OpenBLAS also tells its version.
Blas find_blas()
{
  void *const dgemm = dlsym(RTLD_DEFAULT, "dgemm_");
  const std::string path = library_of(dgemm);
  const std::string file = std::filesystem::path(path).filename().string();
  const std::string library = file.empty() ? "" : " (" + file + ")";
  if (auto *const config = loaded<char *()>("openblas_get_config"))
  {
    // "OpenBLAS 0.3.21 NO_AFFINITY ..."
    std::istringstream words(config());
    std::string name, number;
    words >> name >> number;
    const std::string processor = openblas_processor();
    return {name + " " + number + (processor.empty() ? "" : " for " + processor) + library, false};
  }
  for (const char *known : {"openblas", "mkl", "blis", "atlas", "flexiblas", "Accelerate"})
    if (path.find(known) != std::string::npos)
      return {known + library, false};
  if (path.empty())
    return {"unknown BLAS", false};
  return {"reference BLAS" + library, true};
}
} // namespace

void choose_blas_for_processor()
{
  const char *const relative = known_relative();
  // What it falls back to.
  if (openblas_processor() != "Prescott" || relative == nullptr)
    return;
  // It reads the variable when it is loaded, so it has to begin again.
  auto *const end = loaded<void()>("gotoblas_dynamic_quit");
  auto *const begin = loaded<void()>("gotoblas_dynamic_init");
  constexpr const char *variable = "OPENBLAS_CORETYPE";
  if (end == nullptr || begin == nullptr || std::getenv(variable) != nullptr)
    return;
  setenv(variable, relative, 0);
  end();
  begin();
}

std::string blas_version()
{
  return find_blas().name;
}

bool blas_is_slow()
{
  return find_blas().slow;
}
} // namespace stockwork
