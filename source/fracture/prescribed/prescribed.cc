#include <deal.II/dofs/dof_accessor.h>

#include "discontinuity/cell_size_request.h"
#include "discontinuity/contact.h"
#include "discontinuity/discontinuity.h"
#include "discontinuity/interaction_integral.h"
#include "discontinuity/proppant.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/exchange/released_traction.h"
#include "stockwork/exchange/surroundings.h"
#include "stockwork/fracture/needs.h"
#include "stockwork/fracture/registry.h"

namespace stockwork::prescribed
{
using dealii::Point;
using dealii::Tensor;

/// Given cracks that neither grow nor resist opening: their faces carry the fluid's pressure, and
/// where they touch, one another.
template <int dim>
class Prescribed : public FractureModel<dim>
{
public:
  using typename FractureModel<dim>::CellIterator;

  Prescribed(dealii::ParameterHandler &prm, const Scene<dim> &scene)
    : scene(scene)
    , radius(get_quantity(prm, "Integral radius", dimension::number))
    , tip_functions(prm.get_bool("Tip functions"))
    , cell_size(get_quantity(prm, "Cell size", dimension::length))
    , discontinuity(scene.domain_size)
    , contact(get_quantity(prm, "Friction coefficient", dimension::number),
              1000.,
              scene.rock,
              scene.domain_size)
  {
    contact.keep_apart(propped_gaps(scene.cracks, discontinuity));
    needs::initial_crack(scene, "prescribed");
  }

  static void declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Integral radius", "8", Quantity(dimension::number, Range::closed(2., 1000.)),
                      "Radius of the disc that stress intensity is computed from, in cells; never "
                      "more than 0.4 of the crack or up to another crack.");
    prm.declare_entry("Tip functions", "true", dealii::Patterns::Bool(),
                      "Around each tip, in a disc of up to half the crack, add the displacement of "
                      "a crack tip in an elastic body: the tip then lies exactly where the case "
                      "puts it and needs no small cells. Without, tips move to the nearest edge.");
    prm.declare_entry(
      "Cell size", "0", Quantity(dimension::length, Range::non_negative()),
      "Wanted size of the cells along the crack [m]; zero: that of the given mesh.");
    declare_friction(prm);
  }

  Requirements requirements() const override
  {
    Requirements needs;
    needs.symmetric = !contact.has_friction();
    needs.random_rock = true;
    needs.may_grow = false;
    return needs;
  }

  bool uses_secants() const override
  {
    return contact.uses_secants();
  }

  void setup(const MeshView<dim> &d, const Collectives &collectives) override
  {
    mesh_view = std::make_unique<MeshView<dim>>(d);
    discontinuity.setup(d, collectives);
    std::function<LinearStiffness<dim>(dealii::types::material_id)> rock_of_region;
    if (tip_functions)
      rock_of_region = [this](const dealii::types::material_id region)
      { return LinearStiffness<dim>(scene.rock(region)); };
    discontinuity.cut(scene.cracks, collectives, rock_of_region);
    find_other_rock(collectives);

    all_segments = discontinuity.segments(scene.in_situ_pore_pressure);
    add_proppant(scene.cracks, discontinuity, all_segments);
  }

  std::vector<ExtraUnknown> extra_unknowns() const override
  {
    return discontinuity.enrichment().unknowns();
  }

  dealii::ArrayView<const Segment<dim>> segments() const override
  {
    return dealii::make_array_view(all_segments);
  }

  CellRole<dim> role(const CellIterator &cell) const override
  {
    return {discontinuity.cut_cell(cell->active_cell_index()), nullptr};
  }

  /// The crack releases the in-situ traction of its faces, but for what they go on to carry.
  void assemble(const StepContext &, const State &state, Sink &sink) const override
  {
    LocalSystem local;
    std::vector<Tensor<1, dim>> jumps;
    for (const auto &owned : discontinuity.owned_pieces())
    {
      const auto &piece = discontinuity.paths()[owned.crack].pieces[owned.piece];
      local.extra.clear();
      jumps.clear();
      for (const auto &[extra, jump] : discontinuity.mean_jumps(owned.crack, owned.piece))
      {
        local.extra.push_back(extra);
        jumps.push_back(jump);
      }
      if (jumps.empty())
        continue;
      local.reinit();
      add_released_traction<dim>(scene, piece.centre(), piece.normal(), piece.length(), jumps,
                                 local.residual);
      sink.add(local);
      contact.assemble(discontinuity, owned.crack, owned.piece, state.current.extra, sink);
    }
  }

  void begin_step(const StepContext &context) override
  {
    if (context.step == 1)
      contact.start(scene, discontinuity, [](const CrackPiece<dim> &) { return 1.; });
    contact.begin_step();
  }

  bool commit(const StepContext &, const State &state) override
  {
    for (unsigned int c = 0; c < discontinuity.paths().size(); ++c)
      for (unsigned int i = 0; i < discontinuity.paths()[c].pieces.size(); ++i)
        contact.commit(discontinuity, c, i, state.current.extra);
    return false;
  }

  /// The cracks have stayed as they were; what their faces carry in a step is the contact's.
  void rollback() override
  {
    contact.begin_step();
  }

  std::vector<std::string> take_messages() override
  {
    return contact.take_messages();
  }

  void save(boost::archive::binary_oarchive &archive) const override
  {
    archive << contact;
  }

  void load(boost::archive::binary_iarchive &archive) override
  {
    archive >> contact;
  }

  void wanted_cell_size(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                        std::vector<float> &sizes) const override
  {
    if (mesh_view)
      request_cell_size(triangulation, discontinuity, 4, sizes);
    else if (cell_size > 0.)
      request_cell_size(triangulation, scene.cracks, 4. * cell_size, cell_size, sizes);
  }

  FractureSummary summary(const State &state, const Collectives &collectives) const override
  {
    FractureSummary result;
    for (const auto &path : discontinuity.paths())
    {
      result.length += path.length();
      result.n_tips += path.is_tip[0] + path.is_tip[1];
    }
    result.broken_length = result.length;
    result.dissipated_energy = contact.work();

    const CrackPath<dim> &first = discontinuity.paths().front();
    for (const CrackEnd end : {CrackEnd::last, CrackEnd::first})
      if (first.is_tip[static_cast<int>(end)])
      {
        double r = std::min(radius * first.piece_at(end).cell_size(), 0.4 * first.length());
        for (unsigned int c = 1; c < discontinuity.paths().size(); ++c) // clear of other cracks
          for (const auto &piece : discontinuity.paths()[c].pieces)
            r = std::min(r, 0.9 * piece.centre().distance(first.tip(end)));
        r = std::min(r, other_rock[static_cast<int>(end)]);
        if (r < first.piece_at(end).cell_size())
          break; // across an interface of two rocks it says nothing
        // What the faces carry is not released.
        Scene<dim> released = scene;
        released.in_situ_stress = [&](const Point<dim> &x)
        { return scene.in_situ_stress(x) - carried_stress(0, x, state); };
        const StressIntensity k =
          stress_intensity(0, end, r, *mesh_view, discontinuity, released, state, collectives);
        result.stress_intensity_I = k.opening;
        result.stress_intensity_II = k.shear;
        result.energy_release_rate = k.energy_release_rate;
        break;
      }
    return result;
  }

  void write_fields(const State &state, FieldSink<dim> &sink) const override
  {
    for (const auto &owned : discontinuity.owned_pieces())
    {
      const auto &piece = discontinuity.paths()[owned.crack].pieces[owned.piece];
      Tensor<1, dim> jump;
      for (const auto &[extra, unit] : discontinuity.mean_jumps(owned.crack, owned.piece))
        jump += state.current.extra[extra] * unit;
      std::vector<std::pair<std::string, double>> values{{"aperture", jump * piece.normal()},
                                                         {"slip", jump * piece.along},
                                                         {"damage", 1.},
                                                         {"crack", owned.crack + 1.}};
      const ContactResponse<dim> touching =
        contact.traction(discontinuity, owned.crack, owned.piece, state.current.extra);
      values.emplace_back("contact_pressure", -touching.normal);
      values.emplace_back("friction", touching.shear * piece.along);
      if (state.segment_pressure)
        values.emplace_back("fluid_pressure", state.segment_pressure(discontinuity.segment_key(
                                                owned.crack, owned.piece)));
      sink.add_fracture_piece({piece.ends[0], piece.ends[1]}, values);
    }
  }

private:
  /// Of the first crack's tips, how far it is from each to rock of another stiffness.
  void find_other_rock(const Collectives &collectives)
  {
    const CrackPath<dim> &first = discontinuity.paths().front();
    for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
    {
      const Point<dim> tip = first.tip(end);
      const auto here = LinearStiffness<dim>(scene.rock(first.piece_at(end).region)).tensor();
      const RockProperties &rock = scene.rock(first.piece_at(end).region);
      double nearest = rock.is_random() && rock.random->varies(RandomField::young_modulus)
                         ? 0.
                         : std::numeric_limits<double>::max();
      for (const auto &cell : mesh_view->triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->material_id() != first.piece_at(end).region &&
            (LinearStiffness<dim>(scene.rock(cell->material_id())).tensor() - here).norm() > 0.)
        {
          const auto [low, high] = cell->bounding_box().get_boundary_points();
          Tensor<1, dim> away;
          for (unsigned int d = 0; d < dim; ++d)
            away[d] = std::max({0., low[d] - tip[d], tip[d] - high[d]});
          nearest = std::min(nearest, away.norm());
        }
      other_rock[static_cast<int>(end)] = collectives.min(nearest);
    }
  }

  /// A stress whose traction on the piece with this centre is what its faces exert on one another.
  dealii::SymmetricTensor<2, dim>
  carried_stress(const unsigned int crack, const Point<dim> &centre, const State &state) const
  {
    const auto &pieces = discontinuity.paths()[crack].pieces;
    const auto nearest =
      std::min_element(pieces.begin(), pieces.end(),
                       [&](const auto &a, const auto &b)
                       { return a.centre().distance(centre) < b.centre().distance(centre); });
    const ContactResponse<dim> touching =
      contact.traction(discontinuity, crack, nearest - pieces.begin(), state.current.extra);
    const Tensor<1, dim> n = nearest->normal();
    return touching.normal * symmetrize(outer_product(n, n)) +
           2. * symmetrize(outer_product(n, touching.shear));
  }

  const Scene<dim> &scene;
  double radius;
  bool tip_functions;
  double cell_size;
  Discontinuity<dim> discontinuity;
  FaceContact<dim> contact;
  std::unique_ptr<MeshView<dim>> mesh_view;
  std::vector<Segment<dim>> all_segments;
  std::array<double, 2> other_rock; ///< see find_other_rock() [m]
};


void register_model(FractureModelRegistry &registry);

void register_model(FractureModelRegistry &registry)
{
  FractureModelEntry entry;
  entry.description = "Given cracks that do not grow, under given or computed fluid pressure.";
  entry.declare_parameters = Prescribed<2>::declare_parameters;
  entry.create_2d = [](dealii::ParameterHandler &prm, const Scene<2> &scene)
  { return std::make_unique<Prescribed<2>>(prm, scene); };
  registry.add("prescribed", entry);
}
} // namespace stockwork::prescribed
