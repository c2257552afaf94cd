#ifndef meltfront_verification_record_json_fields_h
#define meltfront_verification_record_json_fields_h

#include <verification/record/json_values.h>

#include <concepts>
#include <type_traits>

namespace meltfront::verification
{
  // Structs as JSON. Of each, fields(visit, object) calls visit(name, member, presence)
  // for every member: that one list is written and read. An enumeration is its
  // to_string(); to read it, read_stored() is specialised.

  /** Whether a member stands in every record. */
  enum class Presence
  {
    always,
    since_later, ///< not in records that were made before it was kept
    if_any       ///< a list: not where it is empty
  };

  template <typename T, typename Struct>
  concept Like = std::same_as<std::remove_const_t<T>, Struct>;

  template <typename T>
  nlohmann::json stored(const T &value);
  template <typename T>
  void read_stored(const nlohmann::json &json, T &value);

  struct JsonFieldWriter
  {
    nlohmann::json &json;

    template <typename T>
    void operator()(const char *name, const T &value,
                    Presence presence = Presence::always) const
    {
      if constexpr(requires { value.empty(); })
        if(presence == Presence::if_any && value.empty())
          return;
      json[name] = stored(value);
    }
  };

  struct JsonFieldReader
  {
    const nlohmann::json &json;

    template <typename T>
    void operator()(const char *name, T &value,
                    Presence presence = Presence::always) const
    {
      if(presence == Presence::always || json.contains(name))
        read_stored(json.at(name), value);
    }
  };

  template <typename T>
  concept HasFields = requires(const JsonFieldWriter &visit, const T &object)
  {
    fields(visit, object);
  };

  template <typename T>
  nlohmann::json stored(const T &value)
  {
    if constexpr(std::is_enum_v<T>)
      return to_string(value);
    else if constexpr(HasFields<T>)
    {
      nlohmann::json json = nlohmann::json::object();
      fields(JsonFieldWriter{json}, value);
      return json;
    }
    else if constexpr(
        std::same_as<
            T,
            double> || std::same_as<T, std::vector<double>> || std::same_as<T, std::map<std::string, double>>)
      return json_of(value);
    else if constexpr(requires { requires HasFields<typename T::value_type>; })
    {
      nlohmann::json json = nlohmann::json::array();
      for(const auto &one : value)
        json.push_back(stored(one));
      return json;
    }
    else
      return value;
  }

  template <typename T>
  void read_stored(const nlohmann::json &json, T &value)
  {
    if constexpr(HasFields<T>)
      fields(JsonFieldReader{json}, value);
    else if constexpr(std::same_as<T, double>)
      value = number_in(json);
    else if constexpr(std::integral<T> && !std::same_as<T, bool>)
      value = whole_number_in<T>(json);
    else if constexpr(std::same_as<T, std::vector<double>>)
      value = numbers_in(json);
    else if constexpr(std::same_as<T, std::map<std::string, double>>)
      value = named_numbers_in(json);
    else if constexpr(requires { requires HasFields<typename T::value_type>; })
      for(const auto &one : json)
        read_stored(one, value.emplace_back());
    else
      json.get_to(value);
  }
} // namespace meltfront::verification

#endif
