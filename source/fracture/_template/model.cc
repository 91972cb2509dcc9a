// Copy this folder to source/fracture/<your_model> and rename the namespace to the folder's name:
// that is the registration. Folders with a leading underscore are compiled, so that this one keeps
// up with the interface, but not registered.
//
// Every function below but the constructor may be left out, and what the interface does then is to
// do nothing; only that commit() comes with rollback(), save(), load() and summary(), or not at
// all. CONTRIBUTING.md goes through them one by one.
#include "law.h"

#include "stockwork/base/quantity.h"
#include "stockwork/fracture/registry.h"

namespace stockwork::_template
{
template <int dim>
class Model : public FractureModel<dim>
{
public:
  using typename FractureModel<dim>::CellIterator;

  /// Called inside the subsection Fracture/<your_model>; `scene` outlives the model.
  Model(dealii::ParameterHandler &prm, const Scene<dim> &scene)
    : scene(scene)
    , strength(get_quantity(prm, "Strength", dimension::stress))
  {
  }

  /// Entries appear in the parameter reference by themselves.
  static void declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Strength", "1 MPa", Quantity(dimension::stress, Range::positive()),
                      "Traction at which the rock begins to open [Pa].");
  }

  /// What is not asked for here is never allocated or called.
  Requirements requirements() const override
  {
    Requirements requirements;
    requirements.pore_pressure = false; // true: cannot run in dry rock
    requirements.law = nullptr;         // a law that role() puts in place of the rock's
    requirements.random_rock = false;   // true: asks for the rock by place, Rock::at()
    return requirements;
  }

  /// The mesh or its numbering is new: find your cells again, and list your segments.
  void setup(const MeshView<dim> &, const Collectives &) override
  {
    all_segments.clear();
  }

  /// Unknowns of your own, recognised by keys that survive renumbering and refinement.
  std::vector<ExtraUnknown> extra_unknowns() const override
  {
    return {};
  }

  /// What the fluid sees. Flow, leak-off, wells and the fluid's load follow from this list.
  dealii::ArrayView<const Segment<dim>> segments() const override
  {
    return dealii::make_array_view(all_segments);
  }

  /// Ordinary, cut, with rows that assemble() provides, or with a law of your own.
  CellRole<dim> role(const CellIterator &) const override
  {
    return {};
  }

  /// Terms of your own: a function of committed history and of the state, nothing else. It may be
  /// called any number of times. This is where law.h is used.
  void assemble(const StepContext &, const State &, Sink &) const override
  {
  }

  /// Converged: does the fracture grow? Then say topology_changed, and the step is solved again.
  Verdict advance(const StepContext &, const State &, const Collectives &) override
  {
    return {};
  }

  /// Trial history becomes history; true: call setup() before the next step.
  bool commit(const StepContext &, const State &) override
  {
    committed_opening = trial_opening;
    return false;
  }

  /// As if the step had never been.
  void rollback() override
  {
    trial_opening = committed_opening;
  }

  /// For a restart. Committed state only.
  void save(boost::archive::binary_oarchive &archive) const override
  {
    archive &committed_opening;
  }

  void load(boost::archive::binary_iarchive &archive) override
  {
    archive &committed_opening;
    trial_opening = committed_opening;
  }

  /// The same columns for every model.
  FractureSummary summary(const State &, const Collectives &) const override
  {
    return {};
  }

private:
  const Scene<dim> &scene;
  double strength;               ///< [Pa]
  double committed_opening = 0.; ///< history, as of the last accepted step [m]
  double trial_opening = 0.;     ///< the same, within the step
  std::vector<Segment<dim>> all_segments;
};


template <int dim>
std::unique_ptr<Model<dim>> create(dealii::ParameterHandler &prm, const Scene<dim> &scene)
{
  return std::make_unique<Model<dim>>(prm, scene);
}


void register_model(FractureModelRegistry &registry);

void register_model(FractureModelRegistry &registry)
{
  FractureModelEntry entry;
  entry.description = "One sentence for --print-parameters.";
  entry.declare_parameters = Model<2>::declare_parameters;
  entry.create_2d = create<2>;
  entry.create_3d = create<3>; // leave out what does not exist
  registry.add("_template", entry);
}
} // namespace stockwork::_template
