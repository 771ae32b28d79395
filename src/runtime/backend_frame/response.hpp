// SPDX-License-Identifier: MIT
#pragma once

// What VPLs do to the image, from the visibility that a BackendFrame stored.

#include "mir/resident/uploaded_vpls.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "runtime/backend_frame.hpp"

namespace mir {

template <Backend M, Bsdf B>
class BackendFrame<M, B>::Response final : public FrameResponse {
 public:
    Response(BackendFrame& frame, Extent luxels, std::uint32_t vpls, float bound)
        : frame_(frame), shading_{bound}, sum_(frame.machine_, luxels, vpls) {}

    void add(const FrameBand& band, Vpls vpls) override {
        UploadedVpls<M> there(frame_.machine_, vpls);
        const WaitAtEnd wait(frame_.queue_);
        there.send(frame_.queue_);
        sum_.add_band(frame_.queue_, of(band).gbuffer, there.view(), *of(band).visibility,
                      shading_);
        frame_.queue_.record().sync();
    }
    [[nodiscard]] std::vector<ImageResponse> mean() override { return sum_.mean(frame_.queue_); }

 private:
    BackendFrame& frame_;
    VplShading<B> shading_;
    BackendResponse<M> sum_;
};

template <Backend M, Bsdf B>
ResponsePtr BackendFrame<M, B>::response(Extent luxels, std::uint32_t vpls, float bound) {
    return std::make_unique<Response>(*this, luxels, vpls, bound);
}

}  // namespace mir
