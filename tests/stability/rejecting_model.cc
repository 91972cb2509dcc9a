// A plug-in for tests: the model cohesive_xfem, but it rejects a step that has converged and grown,
// as a model would whose state has become inadmissible. What the rejected attempt has done must
// leave no trace: the run must equal the one in which the step before has been held back. Other
// steps are as long as the one before.
#include "stockwork/fracture/registry.h"

namespace
{
using stockwork::Collectives;
using stockwork::State;
using stockwork::StepContext;
using stockwork::Verdict;

class Rejecting : public stockwork::FractureModel<2>
{
public:
  Rejecting(std::unique_ptr<stockwork::FractureModel<2>> model, dealii::ParameterHandler &prm)
    : model(std::move(model))
    , rejects(prm.get_bool("Reject"))
    , step(prm.get_integer("Step"))
  {
  }

  Verdict
  advance(const StepContext &context, const State &state, const Collectives &collectives) override
  {
    Verdict verdict = model->advance(context, state, collectives);
    if (verdict.kind == Verdict::Kind::accept)
    {
      verdict.advances.reset();
      verdict.held_back = !rejects && context.step + 1 == step;
      if (rejects && context.step == step && context.attempt == 0)
        verdict = {Verdict::Kind::reject, "the test rejects it"};
    }
    return verdict;
  }

  // All else is the model's.
  stockwork::Requirements requirements() const override
  {
    return model->requirements();
  }
  void setup(const stockwork::MeshView<2> &mesh_view, const Collectives &collectives) override
  {
    model->setup(mesh_view, collectives);
  }
  void begin_step(const StepContext &context) override
  {
    model->begin_step(context);
  }
  std::vector<stockwork::ExtraUnknown> extra_unknowns() const override
  {
    return model->extra_unknowns();
  }
  dealii::ArrayView<const stockwork::Segment<2>> segments() const override
  {
    return model->segments();
  }
  stockwork::CellRole<2> role(const CellIterator &cell) const override
  {
    return model->role(cell);
  }
  void
  assemble(const StepContext &context, const State &state, stockwork::Sink &sink) const override
  {
    model->assemble(context, state, sink);
  }
  bool commit(const StepContext &context, const State &state) override
  {
    return model->commit(context, state);
  }
  void rollback() override
  {
    model->rollback();
  }
  std::vector<std::string> take_messages() override
  {
    return model->take_messages();
  }
  void save(boost::archive::binary_oarchive &archive) const override
  {
    model->save(archive);
  }
  void load(boost::archive::binary_iarchive &archive) override
  {
    model->load(archive);
  }
  void wanted_cell_size(const dealii::parallel::distributed::Triangulation<2> &triangulation,
                        std::vector<float> &sizes) const override
  {
    model->wanted_cell_size(triangulation, sizes);
  }
  stockwork::FractureSummary summary(const State &state,
                                     const Collectives &collectives) const override
  {
    return model->summary(state, collectives);
  }

private:
  std::unique_ptr<stockwork::FractureModel<2>> model;
  bool rejects;
  unsigned int step;
};
} // namespace


extern "C" void stockwork_register(stockwork::FractureModelRegistry &registry)
{
  const auto inner = registry.find("cohesive_xfem");
  stockwork::FractureModelEntry entry;
  entry.description = "cohesive_xfem with steps that are rejected.";
  entry.declare_parameters = [inner](dealii::ParameterHandler &prm)
  {
    inner.declare_parameters(prm);
    using namespace dealii::Patterns;
    prm.declare_entry("Reject", "true", Bool(), "Reject, or hold the step before back.");
    prm.declare_entry("Step", "7", Integer(2), "The step that is rejected.");
  };
  entry.create_2d = [inner](dealii::ParameterHandler &prm, const stockwork::Scene<2> &scene)
  { return std::make_unique<Rejecting>(inner.create_2d(prm, scene), prm); };
  registry.add("rejecting", entry);
}
