// SPDX-License-Identifier: MIT
#include "mir/denoise/denoiser.hpp"

#include "denoise/oidn_api.hpp"

#include <cstdint>

namespace mir {
namespace oidn {
namespace {

/// @throws Error for what the library has to say of the last calls.
void check(const Api& api, Device device) {
    const char* message = nullptr;
    const int code = api.get_device_error(device, &message);
    if (code == error_none) return;
    if (code == error_cancelled)
        throw Error(ErrorCode::cancelled, "the denoising was cancelled; nothing was written");
    throw Error(ErrorCode::device, "Open Image Denoise failed (" +
                                       std::string(message != nullptr ? message : "") +
                                       "); leave --denoise out, or try another version of it");
}

/// "2.5.1" of 20501.
std::string version_text(int version) {
    return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
           std::to_string(version % 100);
}

}  // namespace

/// A device of the library, committed.
class OpenDevice {
 public:
    OpenDevice(const Api& api, unsigned threads)
        : api_(api), device_(api.new_device(processor_device)) {
        check(api_, device_);
        if (device_ == nullptr)
            throw Error(ErrorCode::device,
                        "Open Image Denoise makes no device for this processor (it gives no "
                        "reason); leave --denoise out, or try another version of it");
        // The program that this runs in may have plans for its threads.
        api_.set_device_bool(device_, "setAffinity", false);
        if (threads > 0) api_.set_device_int(device_, "numThreads", static_cast<int>(threads));
        api_.commit_device(device_);
    }
    OpenDevice(const OpenDevice&) = delete;
    OpenDevice& operator=(const OpenDevice&) = delete;
    ~OpenDevice() {
        if (device_ != nullptr) api_.release_device(device_);
    }

    [[nodiscard]] Device get() const { return device_; }

 private:
    const Api& api_;
    Device device_;
};

/// A filter for noise of path-traced and like pictures.
class OpenFilter {
 public:
    OpenFilter(const Api& api, Device device)
        : api_(api), device_(device), filter_(api.new_filter(device, "RT")) {
        check(api_, device_);
    }
    OpenFilter(const OpenFilter&) = delete;
    OpenFilter& operator=(const OpenFilter&) = delete;
    ~OpenFilter() { api_.release_filter(filter_); }

    /// Reads or writes `image`, which has three floats a pixel.
    template <class T>
    void use(const char* name, const Image<T>& image) {
        static_assert(sizeof(T) == 3 * sizeof(float));
        // One function for what is read and for what is written.
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
        api_.set_filter_image(filter_, name, const_cast<T*>(image.pixels().data()), three_floats,
                              image.width(), image.height(), 0, 0, 0);
    }
    void switch_on(const char* name) { api_.set_filter_bool(filter_, name, true); }
    void run(Monitor* monitor) {
        if (monitor != nullptr) api_.set_filter_progress(filter_, goes_on, monitor);
        api_.commit_filter(filter_);
        check(api_, device_);
        api_.execute_filter(filter_);
        check(api_, device_);
    }

 private:
    static bool goes_on(void* monitor, double) {
        return !static_cast<const Monitor*>(monitor)->cancelled.load(std::memory_order_relaxed);
    }

    const Api& api_;
    Device device_;
    Filter filter_;
};

}  // namespace oidn

namespace {

template <class T>
bool fits_picture(const Image<T>* guide, Extent size) {
    return guide == nullptr || guide->extent() == size;
}

/// Null for an empty guide.
template <class T>
const Image<T>* filled(const Image<T>& guide) {
    return guide.extent().area() > 0 ? &guide : nullptr;
}

}  // namespace

struct Denoiser::Parts {
    Parts(const std::filesystem::path& library, unsigned threads)
        : api(oidn::load(library)), device(api, threads) {
        oidn::check(api, device.get());
        name =
            "Open Image Denoise " + oidn::version_text(api.get_device_int(device.get(), "version"));
    }

    oidn::Api api;
    oidn::OpenDevice device;
    std::string name;
};

Denoiser::Denoiser(const std::filesystem::path& library, unsigned threads)
    : parts_(std::make_unique<Parts>(library, threads)) {}

Denoiser::~Denoiser() = default;

const std::string& Denoiser::name() const { return parts_->name; }

Image<Rgb> Denoiser::denoise(const Image<Rgb>& picture, const DenoiseGuides& guides,
                             Monitor* monitor) const {
    const Extent size = picture.extent();
    expects(size.area() > 0,
            "a picture without pixels was to be denoised (there is nothing in it); render one");
    expects(fits_picture(guides.albedo, size) && fits_picture(guides.normal, size),
            "guides of another size than the picture were given (they tell of each of its pixels); "
            "render both together");
    if (monitor != nullptr) monitor->stage = "denoising";
    auto clean = Image<Rgb>::unwritten(size);
    oidn::OpenFilter filter(parts_->api, parts_->device.get());
    filter.use("color", picture);
    if (guides.albedo != nullptr) {
        filter.use("albedo", *guides.albedo);
        if (guides.normal != nullptr) filter.use("normal", *guides.normal);
    }
    filter.use("output", clean);
    filter.switch_on("hdr");
    filter.run(monitor);
    return clean;
}

Image<Rgb> denoise(const RenderResult& result, const Denoiser& denoiser, Monitor* monitor) {
    const DenoiseGuides guides{filled(result.guides.albedo), filled(result.guides.normal)};
    Image<Rgb> sum = denoiser.denoise(result.direct, guides, monitor);
    const Image<Rgb> indirect = denoiser.denoise(result.indirect, guides, monitor);
    for (std::size_t i = 0; i < sum.pixels().size(); ++i)
        sum.pixels()[i] = result.emission.pixels()[i] + (sum.pixels()[i] + indirect.pixels()[i]);
    return sum;
}

}  // namespace mir
