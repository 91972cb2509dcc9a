#include "stockwork/base/lone_process.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace stockwork
{
void start_lone_process_quickly()
{
  constexpr std::array set_by_launchers{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK",
                                        "SLURM_PROCID"};
  if (std::any_of(set_by_launchers.begin(), set_by_launchers.end(),
                  [](const char *name) { return std::getenv(name); }))
    return;
  constexpr int keep = 0;
  setenv("OMPI_MCA_ess_singleton_isolated", "1", keep);
  setenv("OMPI_MCA_pml", "ob1", keep);
  // All of them would share one directory for this session, which each removes when it ends.
  setenv("OMPI_MCA_orte_create_session_dirs", "0", keep);
  // This one keeps its file there, and complains for every file of a checkpoint.
  setenv("OMPI_MCA_sharedfp", "^sm", keep);
}
} // namespace stockwork
