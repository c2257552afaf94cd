#include <cases/error.h>
#include <verification/app/field_writer.h>

#include <deal.II/base/data_out_base.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <tuple>

namespace meltfront::verification
{
  namespace
  {
    /** The arrays of a snapshot that are written, and at which points. */
    struct Fields
    {
      std::vector<std::string> names;
      std::vector<std::span<const double>> values;
      std::vector<
          std::tuple<unsigned int, unsigned int, std::string,
                     dealii::DataComponentInterpretation::DataComponentInterpretation>>
          vectors;
      std::array<std::span<const double>, 3> positions;

      void add(const char *name, std::span<const double> array)
      {
        if(array.empty() || array.size() != positions[0].size())
          return;
        names.emplace_back(name);
        values.push_back(array);
      }
    };

    /** Components beyond the dimension are zero; ParaView's vectors have three. */
    void add_velocity(const cases::Snapshot &snapshot, std::span<const double> zeros,
                      Fields &fields)
    {
      if(snapshot.velocity[0].empty())
        return;
      const auto first = static_cast<unsigned int>(fields.names.size());
      constexpr const char *names[] = {"velocity_x", "velocity_y", "velocity_z"};
      for(int d = 0; d < 3; ++d)
        fields.add(names[d], snapshot.velocity[d].empty() ? zeros : snapshot.velocity[d]);
      fields.vectors.emplace_back(
          first, first + 2, "velocity",
          dealii::DataComponentInterpretation::component_is_part_of_vector);
    }

    Fields fields_of(const cases::Snapshot &snapshot, std::vector<double> &zeros)
    {
      Fields fields;
      const bool sites = !snapshot.positions[0].empty();
      fields.positions = sites ? snapshot.positions : snapshot.front;
      fields.add("temperature", snapshot.temperature);
      fields.add("solid_fraction", snapshot.solid_fraction);
      fields.add("volume", snapshot.weights);
      if(!sites)
        fields.add("curvature", snapshot.front_curvature);
      zeros.assign(fields.positions[0].size(), 0);
      add_velocity(snapshot, zeros, fields);
      if(fields.names.empty()) // deal.II wants one
        fields.add("index", zeros);
      return fields;
    }

    template <int dim>
    using Patches = std::vector<dealii::DataOutBase::Patch<dim, 3>>;

    template <int dim>
    constexpr std::size_t vertices_of_cell = std::size_t(1) << dim;

    /** One patch for each of n cells of dimension dim, given by its vertices, from one
     * on; for dim = 0 for each site. */
    template <int dim, typename Index>
    Patches<dim> make_patches(const Fields &fields, std::span<const Index> cells,
                              std::size_t first, std::size_t n)
    {
      constexpr std::size_t vertices = vertices_of_cell<dim>;
      Patches<dim> patches(n);
      for(std::size_t i = 0; i < n; ++i)
      {
        patches[i].patch_index = i;
        patches[i].data.reinit(fields.names.size(), vertices);
        for(std::size_t v = 0; v < vertices; ++v)
        {
          const std::size_t site
              = dim == 0 ? first + i : cells[vertices * (first + i) + v];
          for(int d = 0; d < 3; ++d)
            if(!fields.positions[d].empty())
              patches[i].vertices[v][d] = fields.positions[d][site];
          for(std::size_t f = 0; f < fields.values.size(); ++f)
            patches[i].data(f, v) = fields.values[f][site];
        }
      }
      return patches;
    }

    /** In pieces of the file, since deal.II takes some 700 bytes for each cell of one. */
    template <int dim, typename Index>
    void write_frame(const cases::Snapshot &snapshot, std::span<const Index> cells,
                     std::ostream &out)
    {
      using dealii::DataOutBase::VtkFlags;
      constexpr std::size_t cells_of_piece = 1 << 17;
      std::vector<double> zeros;
      const Fields fields = fields_of(snapshot, zeros);
      const std::size_t n
          = dim == 0 ? fields.positions[0].size() : cells.size() / vertices_of_cell<dim>;
      VtkFlags flags(snapshot.time, snapshot.step);
      // The best one, deal.II's default, takes twenty times as long as many a run.
      flags.compression_level = VtkFlags::best_speed;
      dealii::DataOutBase::write_vtu_header(out, flags);
      std::size_t first = 0;
      do
      {
        const std::size_t end = std::min(n, first + cells_of_piece);
        dealii::DataOutBase::write_vtu_main(
            make_patches<dim>(fields, cells, first, end - first), fields.names,
            fields.vectors, flags, out);
        // Time and step stand in front of the pieces.
        flags.time = VtkFlags().time;
        flags.cycle = VtkFlags().cycle;
        first = end;
      } while(first < n);
      dealii::DataOutBase::write_vtu_footer(out);
    }

    void write_sites(const cases::Snapshot &snapshot, std::ostream &out)
    {
      const std::span cells(snapshot.cells);
      switch(cells.empty() ? 0 : snapshot.dimension)
      {
      case 0:
        write_frame<0>(snapshot, cells, out);
        break;
      case 1:
        write_frame<1>(snapshot, cells, out);
        break;
      case 2:
        write_frame<2>(snapshot, cells, out);
        break;
      default:
        write_frame<3>(snapshot, cells, out);
      }
    }

    /** Pairs of solid particles nearer than a distance, found by sweeping along x. */
    std::vector<std::size_t> bonds_of(const cases::Snapshot &snapshot, double distance)
    {
      std::vector<std::size_t> order;
      for(std::size_t i = 0; i < snapshot.solid_fraction.size(); ++i)
        if(snapshot.solid_fraction[i] >= 0.5)
          order.push_back(i);
      const auto &r = snapshot.positions;
      std::ranges::sort(order, {}, [&r](std::size_t i) { return r[0][i]; });
      std::vector<std::size_t> pairs;
      for(std::size_t a = 0; a < order.size(); ++a)
        for(std::size_t b = a + 1;
            b < order.size() && r[0][order[b]] - r[0][order[a]] < distance; ++b)
        {
          double square = 0;
          for(int d = 0; d < snapshot.dimension; ++d)
          {
            const double way = r[d][order[b]] - r[d][order[a]];
            square += way * way;
          }
          if(square < distance * distance)
            pairs.insert(pairs.end(), {order[a], order[b]});
        }
      return pairs;
    }
  } // namespace

  FieldWriter::FieldWriter(const std::string &directory, double start_time,
                           double end_time, int frames, double bond, Piece piece)
    : directory(directory)
    , start_time(start_time)
    , end_time(end_time)
    , frames(frames)
    , bond(bond)
    , piece(piece)
  {
    if(!piece.goes_on)
      remove_other_frames();
  }

  /** Fields of an earlier run in the same directory, or of a later time, would mix with
   * this one's. */
  void FieldWriter::remove_other_frames() const
  {
    if(piece.rank > 0)
      return;
    for(const auto &entry : std::filesystem::directory_iterator(directory))
    {
      const std::string name = entry.path().filename().string();
      for(const auto &[collection, frames_of] :
          {std::pair<std::string, const Frames &>("fields", written),
           std::pair<std::string, const Frames &>("bonds", bonds_written)})
      {
        const bool is_frame = name.starts_with(collection + "-")
                              && (name.ends_with(".vtu") || name.ends_with(".pvtu"));
        // Files of one frame are alike up to the first dot.
        const bool stays = std::ranges::any_of(frames_of,
                                               [&](const auto &frame)
                                               {
                                                 const std::string &file = frame.second;
                                                 return name.starts_with(
                                                     file.substr(0, file.find('.') + 1));
                                               });
        if(name == collection + ".pvd" || (is_frame && !stays))
          std::filesystem::remove_all(entry.path());
      }
    }
  }

  void FieldWriter::begin(const cases::RunDescription &)
  {
    remove_other_frames();
  }

  std::string FieldWriter::state() const
  {
    std::ostringstream out;
    boost::archive::binary_oarchive(out) << next_frame << written << bonds_written;
    return std::move(out).str();
  }

  void FieldWriter::go_on_from(const std::string &state)
  {
    std::istringstream in(state);
    boost::archive::binary_iarchive(in) >> next_frame >> written >> bonds_written;
    remove_other_frames();
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
    write("fields", written, snapshot,
          [&](std::ostream &out) { write_sites(snapshot, out); });
    if(bond > 0)
      write("bonds", bonds_written, snapshot,
            [&](std::ostream &out)
            {
              const std::vector<std::size_t> pairs = bonds_of(snapshot, bond);
              write_frame<1>(snapshot, std::span(pairs), out);
            });
  }

  template <typename Write>
  void FieldWriter::write(const std::string &collection, Frames &list,
                          const cases::Snapshot &snapshot, const Write &write_frame) const
  {
    const std::string name = fmt::format("{}-{:04}", collection, list.size());
    const bool in_pieces = piece.ranks > 1;
    const auto name_of_piece
        = [&](int rank) { return fmt::format("{}.{:04}.vtu", name, rank); };
    list.emplace_back(snapshot.time, name + (in_pieces ? ".pvtu" : ".vtu"));
    const auto to_file = [this](const std::string &file, const auto &content)
    {
      const std::string path = directory + "/" + file;
      std::ofstream out(path);
      if(!out)
        throw cases::OutputError(fmt::format("cannot write {}", path));
      content(out);
      if(!out.flush())
        throw cases::OutputError(fmt::format("cannot write {}", path));
    };
    to_file(in_pieces ? name_of_piece(piece.rank) : list.back().second, write_frame);
    if(piece.rank > 0)
      return;
    if(in_pieces)
      to_file(list.back().second,
              [&](std::ostream &out)
              {
                std::vector<std::string> pieces;
                for(int rank = 0; rank < piece.ranks; ++rank)
                  pieces.push_back(name_of_piece(rank));
                std::vector<double> zeros;
                const Fields fields = fields_of(snapshot, zeros);
                dealii::DataOutBase::write_pvtu_record(
                    out, pieces, fields.names, fields.vectors,
                    dealii::DataOutBase::VtkFlags(snapshot.time, snapshot.step));
              });
    to_file(collection + ".pvd", [&list](std::ostream &out)
            { dealii::DataOutBase::write_pvd_record(out, list); });
  }
} // namespace meltfront::verification
