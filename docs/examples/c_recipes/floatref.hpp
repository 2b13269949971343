// Objects of libfloatref in C++17: memory of their own, freed by scope, and exceptions.
#pragma once
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <floatref.h>

namespace floatref {

// A call that was refused; what() is the line of the library.
class error : public std::runtime_error {
public:
    explicit error(fr_status status) : std::runtime_error(fr_status_text(status)), status(status) {}
    const fr_status status;
};

inline void check(fr_status status)
{
    if (status != FR_OK)
        throw error(status);
}

// An object holds no pointer, so copying its memory copies its state: the copy goes on alike.
template <class Config, class Object, std::size_t (*Size)(const Config *),
          fr_status (*Init)(void *, std::size_t, const Config *, Object **)>
class owned {
public:
    explicit owned(const Config &config) : memory_(Size(&config) / sizeof(std::uint64_t) + 1)
    {
        Object *object = nullptr;
        check(Init(memory_.data(), memory_.size() * sizeof(std::uint64_t), &config, &object));
    }

    // For the functions of the library: fr_iri_push(iri.get(), ...).
    Object *get() { return reinterpret_cast<Object *>(memory_.data()); }

    // Push by a function of the library with one output; the room grows to what it asks for.
    template <class Push> std::vector<fr_real> push(Push call)
    {
        std::vector<fr_real> out(1);
        std::size_t written = 0;
        fr_status status = call(get(), out.data(), out.size(), &written);
        if (status == FR_OUTPUT_FULL) {
            out.resize(written);
            status = call(get(), out.data(), out.size(), &written);
        }
        check(status);
        out.resize(written);
        return out;
    }

private:
    std::vector<std::uint64_t> memory_;
};

using iri = owned<fr_iri_config, fr_iri, fr_iri_size, fr_iri_init>;
using adaptive = owned<fr_adaptive_config, fr_adaptive, fr_adaptive_size, fr_adaptive_init>;
using filter = owned<fr_filter_config, fr_filter, fr_filter_size, fr_filter_init>;
using causes = owned<fr_causes_config, fr_causes, fr_causes_size, fr_causes_init>;

} // namespace floatref
