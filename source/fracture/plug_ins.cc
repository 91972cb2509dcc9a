#include "fracture/plug_ins.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <dlfcn.h>

#include <filesystem>

namespace stockwork
{
void load_plug_ins(const Deck &deck, FractureModelRegistry &registry)
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
    using Register = void (*)(FractureModelRegistry &);
    const auto register_models = reinterpret_cast<Register>(dlsym(handle, "stockwork_register"));
    if (register_models == nullptr)
      throw EntryError(entry, name, "a library with the C function 'stockwork_register'");
    register_models(registry);
  }
}
} // namespace stockwork
