#pragma once
#include <Eigen/Core>
#include <cstddef>

#include "core/sdk/registrar.hpp"

namespace signorini::sdk {

/// One property of a build on which two builds must agree before C++ objects may pass between them.
/// A C struct whose layout never changes: it is read before anything else is known about a plugin.
struct FingerprintField {
  const char* name;
  const char* text;  ///< the value, or null when it is `number`
  long long number;
};

// Everything below has internal linkage on purpose: each translation unit describes the flags it was compiled with.

#if defined(__clang__)
static constexpr const char* compiler = "clang";
static constexpr long long compiler_major = __clang_major__;
#elif defined(__GNUC__)
static constexpr const char* compiler = "gcc";
static constexpr long long compiler_major = __GNUC__;
#else
#error "signorini plugins need GCC or Clang"
#endif

#if defined(__GLIBCXX__)
static constexpr const char* standard_library = "libstdc++";
static constexpr long long standard_library_major = _GLIBCXX_RELEASE;
static constexpr long long standard_library_abi = _GLIBCXX_USE_CXX11_ABI;
#elif defined(_LIBCPP_VERSION)
static constexpr const char* standard_library = "libc++";
static constexpr long long standard_library_major = _LIBCPP_VERSION / 1000;
static constexpr long long standard_library_abi = _LIBCPP_ABI_VERSION;
#else
#error "signorini plugins need libstdc++ or libc++"
#endif

#if defined(_GLIBCXX_DEBUG) || defined(_LIBCPP_DEBUG)
static constexpr long long standard_library_debug = 1;
#else
static constexpr long long standard_library_debug = 0;
#endif

#if defined(__x86_64__)
static constexpr const char* architecture = "x86_64";
#elif defined(__aarch64__)
static constexpr const char* architecture = "aarch64";
#else
static constexpr const char* architecture = "other";
#endif

#if defined(__cpp_exceptions)
static constexpr long long exceptions = 1;
#else
static constexpr long long exceptions = 0;
#endif

// Infinities mean that there is no bound, and NaN must stay what it is.
#if defined(__FAST_MATH__)
static constexpr long long fast_math = 1;
#else
static constexpr long long fast_math = 0;
#endif

// The one field in which builds may differ.
static constexpr const char* optimised = "optimised";
#if defined(__OPTIMIZE__)
static constexpr long long optimisation = 1;
#else
static constexpr long long optimisation = 0;
#endif

// GCC announces sanitizers by macros, Clang by features. The undefined behaviour sanitizer changes no interface.
#if defined(__has_feature)
#define SIGNORINI_HAS_FEATURE(name) __has_feature(name)
#else
#define SIGNORINI_HAS_FEATURE(name) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || SIGNORINI_HAS_FEATURE(address_sanitizer)
static constexpr const char* sanitizer = "address";
#elif defined(__SANITIZE_THREAD__) || SIGNORINI_HAS_FEATURE(thread_sanitizer)
static constexpr const char* sanitizer = "thread";
#else
static constexpr const char* sanitizer = "none";
#endif
#undef SIGNORINI_HAS_FEATURE

#define SIGNORINI_NUMBER(name, value) \
  FingerprintField { name, nullptr, static_cast<long long>(value) }
#define SIGNORINI_SIZE(type) SIGNORINI_NUMBER("size of " #type, sizeof(type))
#define SIGNORINI_OFFSET(type, member) SIGNORINI_NUMBER("offset of " #type "::" #member, offsetof(type, member))
#define SIGNORINI_LAYOUT_OF_BLOCKS(B)                                                                      \
  SIGNORINI_SIZE(LevelView<B>), SIGNORINI_OFFSET(LevelView<B>, x), SIGNORINI_OFFSET(LevelView<B>, slot),   \
      SIGNORINI_OFFSET(LevelView<B>, relaxation), SIGNORINI_OFFSET(LevelView<B>, data),                    \
      SIGNORINI_OFFSET(LevelView<B>, facet), SIGNORINI_SIZE(Facet<B>), SIGNORINI_SIZE(LocalConstraint<B>), \
      SIGNORINI_OFFSET(LocalConstraint<B>, direction), SIGNORINI_OFFSET(LocalConstraint<B>, upper),        \
      SIGNORINI_SIZE(QuadraticModel<B>)

/// The build of this translation unit.
static constexpr FingerprintField fingerprint[] = {
    {"compiler", compiler, 0},
    {"compiler major version", nullptr, compiler_major},
    {"standard library", standard_library, 0},
    {"standard library major version", nullptr, standard_library_major},
    {"standard library ABI", nullptr, standard_library_abi},
    {"standard library debug mode", nullptr, standard_library_debug},
    {"architecture", architecture, 0},
    {"exceptions", nullptr, exceptions},
    {"sanitizer", sanitizer, 0},
    {"fast math", nullptr, fast_math},
    {"finite math only", nullptr, __FINITE_MATH_ONLY__},
    {optimised, nullptr, optimisation},
    SIGNORINI_NUMBER("Eigen version", 10000 * EIGEN_WORLD_VERSION + 100 * EIGEN_MAJOR_VERSION + EIGEN_MINOR_VERSION),
    SIGNORINI_NUMBER("EIGEN_MAX_ALIGN_BYTES", EIGEN_MAX_ALIGN_BYTES),
    SIGNORINI_NUMBER("EIGEN_MALLOC_ALREADY_ALIGNED", EIGEN_MALLOC_ALREADY_ALIGNED),
    SIGNORINI_SIZE(void*),
    SIGNORINI_SIZE(double),
    SIGNORINI_SIZE(Index),
    SIGNORINI_SIZE(Offset),
    SIGNORINI_SIZE(Flags),
    SIGNORINI_SIZE(OptionType),
    SIGNORINI_SIZE(Order),
    SIGNORINI_SIZE(Status),
    SIGNORINI_OFFSET(Status, message),
    SIGNORINI_SIZE(OptionSpec),
    SIGNORINI_OFFSET(OptionSpec, help),
    SIGNORINI_SIZE(ObstacleType),
    SIGNORINI_OFFSET(ObstacleType, create1),
    SIGNORINI_OFFSET(ObstacleType, takes_body),
    SIGNORINI_SIZE(ObstacleDescriptor),
    SIGNORINI_OFFSET(ObstacleDescriptor, direction),
    SIGNORINI_SIZE(ObstacleDescriptor::Direction),
    SIGNORINI_SIZE(Distance),
    SIGNORINI_SIZE(FrictionLaw),
    SIGNORINI_SIZE(Placement),
    SIGNORINI_SIZE(SurfaceVertex),
    SIGNORINI_OFFSET(SurfaceVertex, normal),
    SIGNORINI_OFFSET(SurfaceVertex, vertex),
    SIGNORINI_OFFSET(SurfaceVertex, away),
    SIGNORINI_LAYOUT_OF_BLOCKS(1),
    SIGNORINI_LAYOUT_OF_BLOCKS(2),
    SIGNORINI_LAYOUT_OF_BLOCKS(3),
};

static constexpr unsigned fingerprint_fields = sizeof fingerprint / sizeof fingerprint[0];

#undef SIGNORINI_LAYOUT_OF_BLOCKS
#undef SIGNORINI_OFFSET
#undef SIGNORINI_SIZE
#undef SIGNORINI_NUMBER

}  // namespace signorini::sdk
