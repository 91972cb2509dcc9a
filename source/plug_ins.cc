#include "plug_ins.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <dlfcn.h>

#include <filesystem>

namespace stockwork
{
// Written by the build from the folders of source/fracture and source/rock.
void register_all_fracture_models(FractureModelRegistry &registry);
void register_all_rock_laws(RockLawRegistry &registry);


PlugIns PlugIns::own()
{
  PlugIns plug_ins;
  register_all_fracture_models(plug_ins.fracture_models);
  register_all_rock_laws(plug_ins.rock_laws);
  return plug_ins;
}


void PlugIns::load(const Deck &deck)
{
  const std::string entry = "Additional shared libraries";
  const auto list = deck.peek(entry);
  if (!list)
    return;
  for (const std::string &name : split_list(*list))
  {
    const auto file = std::filesystem::path(deck.file()).parent_path() / name;
    void *handle = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (handle == nullptr)
      throw EntryError(entry, name, std::string("a plug-in: ") + dlerror());
    using RegisterModels = void (*)(FractureModelRegistry &);
    using RegisterLaws = void (*)(RockLawRegistry &);
    const auto register_models =
      reinterpret_cast<RegisterModels>(dlsym(handle, "stockwork_register"));
    const auto register_laws =
      reinterpret_cast<RegisterLaws>(dlsym(handle, "stockwork_register_rock_laws"));
    if (register_models == nullptr && register_laws == nullptr)
      throw EntryError(entry, name,
                       "a library with the C function 'stockwork_register' or "
                       "'stockwork_register_rock_laws'");
    if (register_models != nullptr)
      register_models(fracture_models);
    if (register_laws != nullptr)
      register_laws(rock_laws);
  }
}
} // namespace stockwork
