// A fracture model that commits something must be able to take it back, to save it and to sum it
// up.
#include <doctest/doctest.h>

#include "stockwork/fracture/registry.h"

namespace stockwork::made_model_test
{
namespace
{
class WithoutHistory : public FractureModel<2>
{
};

class Forgetful : public FractureModel<2>
{
public:
  bool commit(const StepContext &, const State &) override
  {
    return false;
  }
  void save(boost::archive::binary_oarchive &) const override
  {
  }
  void load(boost::archive::binary_iarchive &) override
  {
  }
  FractureSummary summary(const State &, const Collectives &) const override
  {
    return {};
  }
};

class Mindful : public Forgetful
{
public:
  void rollback() override
  {
  }
};
} // namespace


TEST_CASE("a model with a history is taken only if nothing of it can be forgotten in silence")
{
  CHECK(keeps_what_it_commits<2, WithoutHistory>());
  CHECK_FALSE(keeps_what_it_commits<2, Forgetful>()); // no rollback
  CHECK(keeps_what_it_commits<2, Mindful>());
  const std::unique_ptr<FractureModel<2>> model = MadeModel<2>(std::make_unique<Mindful>());
  CHECK(dynamic_cast<const Mindful *>(model.get()) != nullptr);
}
} // namespace stockwork::made_model_test
