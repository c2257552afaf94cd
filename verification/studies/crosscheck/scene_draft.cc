#include <verification/studies/crosscheck/scene_draft.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace meltfront::verification
{
  namespace
  {
    bool within(const std::string &subsection, const std::string &outer)
    {
      return subsection == outer || subsection.starts_with(outer + "/");
    }

    std::vector<std::string> parts_of(const std::string &path)
    {
      std::vector<std::string> parts;
      std::istringstream stream(path);
      for(std::string part; std::getline(stream, part, '/');)
        parts.push_back(part);
      return parts;
    }

    /** Writes keys of subsections that come in their order. */
    class PrmWriter
    {
    public:
      void write(const std::string &subsection, const std::string &key,
                 const std::string &value)
      {
        move_to(parts_of(subsection));
        line(fmt::format("set {} = {}", key, value));
      }

      void move_to(const std::vector<std::string> &path)
      {
        std::size_t common = 0;
        while(common < std::min(path.size(), open.size()) && path[common] == open[common])
          ++common;
        while(open.size() > common)
        {
          open.pop_back();
          line("end");
        }
        for(std::size_t i = common; i < path.size(); ++i)
        {
          line("subsection " + path[i]);
          open.push_back(path[i]);
        }
      }

      void line(const std::string &words)
      {
        text += std::string(2 * open.size(), ' ') + words + "\n";
      }

      std::string text;

    private:
      std::vector<std::string> open;
    };
  } // namespace

  void SceneDraft::set(const std::string &subsection, const std::string &key,
                       const std::string &value, const std::vector<std::string> &simpler)
  {
    for(Entry &entry : entries)
      if(entry.subsection == subsection && entry.key == key)
      {
        entry.value = value;
        entry.simpler = simpler;
        return;
      }
    entries.push_back({subsection, key, value, simpler});
  }

  std::string SceneDraft::value(const std::string &subsection,
                                const std::string &key) const
  {
    for(const Entry &entry : entries)
      if(entry.subsection == subsection && entry.key == key)
        return entry.value;
    return {};
  }

  bool SceneDraft::has(const std::string &subsection) const
  {
    return std::ranges::any_of(entries, [&](const Entry &entry)
                               { return within(entry.subsection, subsection); });
  }

  void SceneDraft::remove(const std::string &subsection)
  {
    std::erase_if(entries, [&](const Entry &entry)
                  { return within(entry.subsection, subsection); });
  }

  void SceneDraft::remove(const std::string &subsection, const std::string &key)
  {
    std::erase_if(entries, [&](const Entry &entry)
                  { return entry.subsection == subsection && entry.key == key; });
  }

  std::string SceneDraft::text(const std::string &comment) const
  {
    PrmWriter writer;
    std::istringstream lines(comment);
    for(std::string line; std::getline(lines, line);)
      writer.line(line.empty() ? "#" : "# " + line);
    // A subsection is opened once: keys of one that was set late join it.
    std::vector<Entry> sorted = entries;
    std::vector<std::string> order;
    for(const Entry &entry : entries)
    {
      std::string path;
      for(const std::string &part : parts_of(entry.subsection))
      {
        path += (path.empty() ? "" : "/") + part;
        if(std::ranges::find(order, path) == order.end())
          order.push_back(path);
      }
    }
    const auto rank = [&order](const Entry &entry)
    {
      std::vector<std::size_t> ranks;
      std::string path;
      for(const std::string &part : parts_of(entry.subsection))
      {
        path += (path.empty() ? "" : "/") + part;
        ranks.push_back(std::ranges::find(order, path) - order.begin());
      }
      return ranks;
    };
    std::ranges::stable_sort(sorted, {}, rank);
    for(const Entry &entry : sorted)
      writer.write(entry.subsection, entry.key, entry.value);
    writer.move_to({});
    return writer.text;
  }

  std::vector<SceneDraft> SceneDraft::simpler() const
  {
    std::vector<SceneDraft> drafts;
    const auto without = [&](const auto &...what)
    {
      drafts.push_back(*this);
      drafts.back().remove(what...);
    };
    for(const char *optional :
        {"Scene/Volumetric source", "Scene/Inclusion", "Scene/Source 1", "Scene/Source 2",
         "Scene/Material/Liquid"})
      if(has(optional))
        without(optional);
    if(has("Scene/Material/Solute 1"))
    {
      without("Scene/Material/Solute 1");
      drafts.back().remove("Scene/Material/Alloy");
      drafts.back().remove("Scene/Initial state", "concentration");
    }
    for(const char *side :
        {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max", "outer", "inner"})
      if(const std::string wall = std::string("Scene/Walls/") + side; has(wall))
      {
        without(wall);
        // Periodic walls face each other.
        if(value(wall, "kind") == "periodic")
          drafts.back().remove(wall.substr(0, wall.size() - 3)
                               + (wall.ends_with("min") ? "max" : "min"));
      }
    for(const Entry &entry : entries)
    {
      if(entry.subsection == "Scene/Material/Liquid"
         || entry.key == "Gibbs-Thomson coefficient"
         || entry.key == "solid fraction at melting" || entry.key == "diffusivity"
         || entry.key == "front")
        without(entry.subsection, entry.key);
      for(std::size_t i = 0; i < entry.simpler.size(); ++i)
      {
        drafts.push_back(*this);
        // What stands behind it in the list is no simpler than it.
        drafts.back().set(
            entry.subsection, entry.key, entry.simpler[i],
            {entry.simpler.begin(), entry.simpler.begin() + static_cast<long>(i)});
      }
    }
    return drafts;
  }
} // namespace meltfront::verification
