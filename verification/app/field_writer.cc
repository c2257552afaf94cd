#include <cases/error.h>
#include <verification/app/field_writer.h>

#include <deal.II/base/data_out_base.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace meltfront::verification
{
  namespace
  {
    const std::vector<std::string> data_names{"temperature", "solid_fraction", "volume"};

    template <int dim>
    using Patches = std::vector<dealii::DataOutBase::Patch<dim, 3>>;

    template <typename Patch>
    void fill_vertex(Patch &patch, unsigned int vertex, const cases::Snapshot &snapshot,
                     std::size_t site)
    {
      for(int d = 0; d < snapshot.dimension; ++d)
        patch.vertices[vertex][d] = snapshot.positions[d][site];
      patch.data(0, vertex) = snapshot.temperature[site];
      patch.data(1, vertex) = snapshot.solid_fraction[site];
      patch.data(2, vertex) = snapshot.weights[site];
    }

    /** One patch per cell of dimension dim; for dim = 0 one per site. */
    template <int dim>
    Patches<dim> make_patches(const cases::Snapshot &snapshot)
    {
      constexpr std::size_t vertices = std::size_t(1) << dim;
      const std::size_t n
          = dim == 0 ? snapshot.temperature.size() : snapshot.cells.size() / vertices;
      Patches<dim> patches(n);
      for(std::size_t i = 0; i < n; ++i)
      {
        patches[i].patch_index = i;
        patches[i].data.reinit(data_names.size(), vertices);
        for(std::size_t v = 0; v < vertices; ++v)
          fill_vertex(patches[i], v, snapshot,
                      dim == 0 ? i : snapshot.cells[vertices * i + v]);
      }
      return patches;
    }

    template <int dim>
    void write_frame(const cases::Snapshot &snapshot, std::ostream &out)
    {
      const dealii::DataOutBase::VtkFlags flags(snapshot.time, snapshot.step);
      dealii::DataOutBase::write_vtu(make_patches<dim>(snapshot), data_names, {}, flags,
                                     out);
    }
  } // namespace

  FieldWriter::FieldWriter(const std::string &directory, double start_time,
                           double end_time, int frames)
    : directory(directory)
    , start_time(start_time)
    , end_time(end_time)
    , frames(frames)
  {
    // Fields of an earlier run in the same directory would mix with this one's.
    for(const auto &entry : std::filesystem::directory_iterator(directory))
    {
      const std::string name = entry.path().filename().string();
      if(name == "fields.pvd" || (name.starts_with("fields-") && name.ends_with(".vtu")))
        std::filesystem::remove_all(entry.path());
    }
  }

  bool FieldWriter::wants(long, double time)
  {
    // A step may end a rounding error before the frame's time.
    const double span = end_time - start_time;
    return time >= start_time + span * (double(next_frame) / frames - 1e-9);
  }

  void FieldWriter::observe(const cases::Snapshot &snapshot)
  {
    if(!wants(snapshot.step, snapshot.time))
      return;
    while(next_frame <= frames && wants(snapshot.step, snapshot.time))
      ++next_frame;
    const std::string name = fmt::format("fields-{:04}.vtu", written.size());
    const std::string path = directory + "/" + name;
    std::ofstream out(path);
    if(!out)
      throw cases::OutputError(fmt::format("cannot write {}", path));
    switch(snapshot.cells.empty() ? 0 : snapshot.dimension)
    {
    case 0:
      write_frame<0>(snapshot, out);
      break;
    case 1:
      write_frame<1>(snapshot, out);
      break;
    case 2:
      write_frame<2>(snapshot, out);
      break;
    default:
      write_frame<3>(snapshot, out);
    }
    if(!out.flush())
      throw cases::OutputError(fmt::format("cannot write {}", path));
    written.emplace_back(snapshot.time, name);
    write_collection();
  }

  void FieldWriter::write_collection() const
  {
    const std::string path = directory + "/fields.pvd";
    std::ofstream out(path);
    if(!out)
      throw cases::OutputError(fmt::format("cannot write {}", path));
    dealii::DataOutBase::write_pvd_record(out, written);
    if(!out.flush())
      throw cases::OutputError(fmt::format("cannot write {}", path));
  }
} // namespace meltfront::verification
