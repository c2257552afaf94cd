#include <verification/run/checkpoint/observation_log.h>

#include <cases/error.h>
#include <verification/record/hash.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array_wrapper.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <string_view>
#include <utility>

namespace boost::serialization
{
  template <class Archive>
  void serialize(Archive &archive, meltfront::cases::Parameter &parameter, unsigned int)
  {
    archive &parameter.name &parameter.value &parameter.unit;
  }

  template <class Archive>
  void serialize(Archive &archive, meltfront::cases::RunDescription &description,
                 unsigned int)
  {
    archive &description.dimension &description.spacing &description.smoothing_length;
    archive &description.time_step &description.unknowns &description.parameters;
  }

  template <class Archive>
  void serialize(Archive &archive, meltfront::cases::SubstanceBudget &budget,
                 unsigned int)
  {
    archive &budget.now &budget.initial;
  }

  template <class Archive>
  void serialize(Archive &archive, meltfront::cases::HeatBudget &heat, unsigned int)
  {
    archive &heat.stored &heat.latent &heat.boundary &heat.sources &heat.initial;
    archive &heat.conservative;
  }
} // namespace boost::serialization

namespace meltfront::verification
{
  namespace
  {
    // Each entry is an archive of its own, so that entries can be cut off and added: its
    // length, the hash of what it holds, and that.
    constexpr auto headless = boost::archive::no_header;
    constexpr std::size_t hash_digits = 64;

    enum Kind : char
    {
      begin_of_run = 'b',
      step_asked = 's',
      state_shown = 'x',
      event_noted = 'n',
      scalar_reported = 'r'
    };

    /** Visit every array of numbers of a snapshot. */
    template <typename Visit>
    void visit_arrays(cases::Snapshot &snapshot, const Visit &visit)
    {
      for(auto *of_axes : {&snapshot.positions, &snapshot.front, &snapshot.front_normal,
                           &snapshot.velocity})
        for(auto &axis : *of_axes)
          visit(axis);
      for(auto *array : {&snapshot.weights, &snapshot.temperature,
                         &snapshot.solid_fraction, &snapshot.front_curvature})
        visit(*array);
      for(auto &array : snapshot.concentration)
        visit(array);
      visit(snapshot.cells);
    }

    /** All else. */
    template <class Archive>
    void exchange_numbers(Archive &archive, cases::Snapshot &snapshot)
    {
      archive &snapshot.step &snapshot.time &snapshot.dimension;
      archive &snapshot.obeys_maximum_principle &snapshot.heat &snapshot.mass;
      archive &snapshot.vanished_volume;
      for(cases::SubstanceBudget &solute : snapshot.solute)
        archive &solute;
    }

    /** What the views of a snapshot that was read look at. */
    struct Arrays
    {
      std::vector<std::vector<double>> numbers;
      std::vector<std::vector<unsigned int>> indices;
    };

    template <typename Value>
    void read_array(boost::archive::binary_iarchive &archive,
                    std::vector<std::vector<Value>> &kept, std::size_t &next,
                    std::span<const Value> &array)
    {
      if(next == kept.size())
        kept.emplace_back();
      std::vector<Value> &values = kept[next++];
      bool same = false;
      archive >> same;
      if(!same)
      {
        std::size_t size = 0;
        archive >> size;
        values.resize(size);
        archive >> boost::serialization::make_array(values.data(), size);
      }
      array = values;
    }

    cases::Snapshot read_snapshot(boost::archive::binary_iarchive &archive,
                                  Arrays &arrays)
    {
      cases::Snapshot snapshot;
      exchange_numbers(archive, snapshot);
      std::size_t next_numbers = 0, next_indices = 0;
      visit_arrays(
          snapshot,
          [&](auto &array)
          {
            if constexpr(std::is_same_v<decltype(array), std::span<const unsigned int> &>)
              read_array(archive, arrays.indices, next_indices, array);
            else
              read_array(archive, arrays.numbers, next_numbers, array);
          });
      return snapshot;
    }

    /** The next entry, as it was written. @throws cases::OutputError if it is not */
    std::string read_entry(std::istream &in, std::uintmax_t bytes_left)
    {
      std::uintmax_t size = 0;
      std::string hash(hash_digits, ' '), entry;
      in.read(reinterpret_cast<char *>(&size), sizeof(size));
      in.read(hash.data(), hash_digits);
      if(in && size <= bytes_left)
      {
        entry.resize(size);
        in.read(entry.data(), static_cast<std::streamsize>(size));
      }
      if(!in || sha256(entry) != hash)
        throw cases::OutputError("the observations of a run to resume are damaged or cut "
                                 "off: run the case anew");
      return entry;
    }

    void tell_entry(std::istream &in, Arrays &arrays, cases::Observer &observer)
    {
      const int kind = in.get();
      boost::archive::binary_iarchive archive(in, headless);
      switch(kind)
      {
      case begin_of_run:
      {
        cases::RunDescription description;
        archive >> description;
        observer.begin(description);
        break;
      }
      case step_asked:
      {
        long step = 0;
        double time = 0;
        archive >> step >> time;
        observer.wants(step, time);
        break;
      }
      case state_shown:
        observer.observe(read_snapshot(archive, arrays));
        break;
      case event_noted:
      {
        double time = 0;
        std::string event;
        archive >> time >> event;
        observer.note(time, event);
        break;
      }
      case scalar_reported:
      {
        std::string name;
        double value = 0;
        archive >> name >> value;
        observer.report(name, value);
        break;
      }
      default:
        throw cases::OutputError("it holds what is no entry");
      }
    }
  } // namespace

  ObservationLog::ObservationLog(const std::string &path, std::uintmax_t kept_bytes)
    : file(path)
  {
    std::error_code failure;
    if(kept_bytes > 0)
      std::filesystem::resize_file(file, kept_bytes, failure);
    if(!failure)
      out.open(file, std::ios::binary | (kept_bytes > 0 ? std::ios::app : std::ios::out));
    if(failure || !out)
      throw cases::OutputError(fmt::format("cannot write {}", file));
  }

  template <typename Write>
  void ObservationLog::write(char kind, const Write &write_rest)
  {
    std::ostringstream text;
    text.put(kind);
    {
      boost::archive::binary_oarchive archive(text, headless);
      write_rest(archive);
    }
    const std::string entry = std::move(text).str();
    const std::uintmax_t size = entry.size();
    out.write(reinterpret_cast<const char *>(&size), sizeof(size));
    out << sha256(entry) << entry;
  }

  void ObservationLog::begin(const cases::RunDescription &description)
  {
    write(begin_of_run, [&](auto &archive) { archive << description; });
  }

  void ObservationLog::step(long step, double time)
  {
    write(step_asked, [&](auto &archive) { archive << step << time; });
  }

  void ObservationLog::snapshot(const cases::Snapshot &shown)
  {
    // Boost's archives exchange by reference whichever way they go.
    cases::Snapshot snapshot = shown;
    write(state_shown,
          [&](auto &archive)
          {
            exchange_numbers(archive, snapshot);
            std::size_t next = 0;
            visit_arrays(
                snapshot,
                [&](const auto &array)
                {
                  const auto *bytes = reinterpret_cast<const char *>(array.data());
                  const std::string hash
                      = sha256(std::string_view(bytes, array.size_bytes()));
                  if(next == last_hashes.size())
                    last_hashes.emplace_back();
                  const bool same = hash == std::exchange(last_hashes[next++], hash);
                  archive << same;
                  if(same)
                    return;
                  const std::size_t size = array.size();
                  archive << size;
                  archive << boost::serialization::make_array(array.data(), size);
                });
          });
  }

  void ObservationLog::note(double time, const std::string &event)
  {
    write(event_noted, [&](auto &archive) { archive << time << event; });
  }

  void ObservationLog::report(const std::string &name, double value)
  {
    write(scalar_reported, [&](auto &archive) { archive << name << value; });
  }

  std::uintmax_t ObservationLog::bytes()
  {
    if(!out.flush())
      throw cases::OutputError(fmt::format("cannot write {}", file));
    return static_cast<std::uintmax_t>(out.tellp());
  }

  void ObservationLog::tell(const std::string &file, std::uintmax_t bytes,
                            cases::Observer &observer)
  {
    std::ifstream in(file, std::ios::binary);
    Arrays arrays;
    for(std::uintmax_t at = 0; at < bytes; at = static_cast<std::uintmax_t>(in.tellg()))
    {
      std::istringstream entry(read_entry(in, bytes - at));
      tell_entry(entry, arrays, observer);
    }
  }
} // namespace meltfront::verification
