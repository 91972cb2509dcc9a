#include "stockwork/fracture/registry.h"

namespace stockwork::peridynamics
{
// Until the model's own registration arrives; that replaces this file.
void register_model(FractureModelRegistry &);

void register_model(FractureModelRegistry &)
{
}
} // namespace stockwork::peridynamics
