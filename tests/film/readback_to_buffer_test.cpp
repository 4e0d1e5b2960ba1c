#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"
#include "tests/support/sized.h"
#include "tests/vulkan/caller_vulkan.h"
#include "tests/vulkan/held_work.h"

#include <pt/async.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

namespace {

constexpr std::uint32_t lent_width = 61;
constexpr std::uint32_t lent_height = 33;
constexpr std::uint64_t buffer_bytes = 50'000;
constexpr std::uint32_t guard_word = 0xa5a5a5a5;

using BufferContents = std::vector<std::byte>;

class CallersBuffer {
public:
    CallersBuffer(const CallersOwnVulkan &caller, vk::BufferUsageFlags usage) :
        buffer_(caller.device().createBuffer({.size = buffer_bytes, .usage = usage})),
        memory_(allocate(caller)) {
        buffer_.bindMemory(*memory_, 0);
        bytes_ = static_cast<std::byte *>(memory_.mapMemory(0, VK_WHOLE_SIZE));
        std::fill_n(bytes_, buffer_bytes, std::byte{guard_word & 0xff});
    }

    vk::Buffer handle() const { return *buffer_; }
    BufferContents bytes() const { return {bytes_, bytes_ + buffer_bytes}; }

private:
    vk::raii::DeviceMemory allocate(const CallersOwnVulkan &caller) const {
        const vk::MemoryRequirements needs = buffer_.getMemoryRequirements();
        const vk::PhysicalDeviceMemoryProperties types = caller.physical_device().getMemoryProperties();
        constexpr auto wanted = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
        std::uint32_t type = 0;
        while (!(needs.memoryTypeBits >> type & 1U) || (types.memoryTypes.at(type).propertyFlags & wanted) != wanted)
            ++type;
        return caller.device().allocateMemory({.allocationSize = needs.size, .memoryTypeIndex = type});
    }

    vk::raii::Buffer buffer_;
    vk::raii::DeviceMemory memory_;
    std::byte *bytes_ = nullptr;
};

class ReadbackToBufferTest : public CallerVulkanFixture {
protected:
    void SetUp() override {
        CallerVulkanFixture::SetUp();
        pool_ = caller_->device().createCommandPool({.queueFamilyIndex = caller_->family()});
        buffer_.emplace(*caller_, vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferSrc |
                                      vk::BufferUsageFlagBits::eTransferDst);
    }

    void TearDown() override {
        context_.reset();
        commands_.clear();
        pool_.reset();
        buffer_.reset();
        CallerVulkanFixture::TearDown();
    }

    void use_context(bool like_gpus) {
        const pt_vulkan vulkan = caller_->handles();
        auto info = sized<pt_create_info>();
        info.vulkan = &vulkan;
        pt_context *created = nullptr;
        ASSERT_EQ(create_shared(1, info, &created, like_gpus), PT_OK) << pt_last_error(nullptr);
        context_.reset(created);
        const CourseworkScene coursework;
        render_image(context(), coursework.scene(), CourseworkScene::camera(), render_of(lent_width, lent_height, 3),
                     17);
    }

    pt_context *context() const { return context_.get(); }

    pt_buffer_image target() const {
        auto image = sized<pt_buffer_image>();
        image.buffer = std::bit_cast<std::uint64_t>(static_cast<VkBuffer>(buffer_->handle()));
        image.size_bytes = buffer_bytes;
        return image;
    }

    static std::uint64_t handle_of(const vk::raii::Semaphore &semaphore) {
        return std::bit_cast<std::uint64_t>(static_cast<VkSemaphore>(*semaphore));
    }

    BufferContents expected(const pt_buffer_image &image) const {
        BufferContents bytes = untouched_buffer();
        auto part = sized<pt_image>();
        part.quantity = image.quantity;
        part.format = image.format;
        part.data = &bytes[image.offset_bytes];
        part.size_bytes = bytes.size() - image.offset_bytes;
        part.row_bytes = image.row_bytes;
        set_part(part, {image.x, image.y, image.width, image.height});
        EXPECT_EQ(pt_readback(context(), &part), PT_OK) << pt_last_error(context());
        return bytes;
    }

    template <typename Record>
    void submit(const Record &record, vk::Semaphore wait, vk::Semaphore signal) {
        commands_.push_back(std::move(
            caller_->device().allocateCommandBuffers({.commandPool = **pool_, .commandBufferCount = 1}).front()));
        commands_.back().begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        record(commands_.back());
        commands_.back().end();
        const vk::CommandBuffer work = *commands_.back();
        const vk::PipelineStageFlags stages = vk::PipelineStageFlagBits::eTransfer;
        caller_->queue().submit(vk::SubmitInfo{.waitSemaphoreCount = wait ? 1U : 0U,
                                               .pWaitSemaphores = &wait,
                                               .pWaitDstStageMask = &stages,
                                               .commandBufferCount = 1,
                                               .pCommandBuffers = &work,
                                               .signalSemaphoreCount = signal ? 1U : 0U,
                                               .pSignalSemaphores = &signal});
    }

    void copy_to(const CallersBuffer &copy, vk::Semaphore semaphore) {
        submit(
            [&](const vk::raii::CommandBuffer &commands) {
                commands.copyBuffer(buffer_->handle(), copy.handle(), vk::BufferCopy{.size = buffer_bytes});
                constexpr vk::MemoryBarrier to_host{.srcAccessMask = vk::AccessFlagBits::eTransferWrite,
                                                    .dstAccessMask = vk::AccessFlagBits::eHostRead};
                commands.pipelineBarrier(vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost, {},
                                         to_host, {}, {});
            },
            semaphore, {});
        caller_->queue().waitIdle();
    }

    static BufferContents untouched_buffer() { return BufferContents(buffer_bytes, std::byte{guard_word & 0xff}); }

    void refused(const pt_buffer_image &image, pt_result result, const std::string &message) {
        EXPECT_EQ(pt_readback_to_buffer(context(), &image), result);
        EXPECT_EQ(pt_last_error(context()), message);
    }

    std::optional<CallersBuffer> buffer_;
    Context context_;

private:
    std::optional<vk::raii::CommandPool> pool_;
    std::vector<vk::raii::CommandBuffer> commands_;
};

TEST_F(ReadbackToBufferTest, HasTheBitsOfReadback) {
    for (const bool like_gpus : {false, true}) {
        use_context(like_gpus);
        for (const std::uint32_t quantity : {PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR})
            for (const std::uint32_t format : {PT_FORMAT_RGB32F, PT_FORMAT_RGBA32F, PT_FORMAT_RGBA16F}) {
                pt_buffer_image whole = target();
                whole.quantity = quantity;
                whole.format = format;
                pt_buffer_image part = whole;
                part.offset_bytes = 1236;
                set_part(part, {7, 11, 50, 20});
                part.row_bytes = 820;
                for (const pt_buffer_image &image : {whole, part}) {
                    buffer_.emplace(*caller_, vk::BufferUsageFlagBits::eStorageBuffer);
                    pt_buffer_image here = image;
                    here.buffer = target().buffer;
                    ASSERT_EQ(pt_readback_to_buffer(context(), &here), PT_OK) << pt_last_error(context());
                    ASSERT_TRUE(buffer_->bytes() == expected(here))
                        << "quantity " << quantity << ", format " << format << ", x " << here.x;
                }
            }
    }
}

// The validation layer reports wrong semaphores in the second round.
TEST_F(ReadbackToBufferTest, SemaphoresOrderItOnTheDevice) {
    use_context(true);
    const vk::raii::Semaphore before = caller_->device().createSemaphore({});
    const vk::raii::Semaphore after = caller_->device().createSemaphore({});
    const auto fill = [&](const vk::raii::CommandBuffer &commands) {
        commands.fillBuffer(buffer_->handle(), 0, VK_WHOLE_SIZE, guard_word);
    };
    pt_buffer_image image = target();
    image.wait_semaphore = handle_of(before);
    for (int round = 0; round < 2; ++round) {
        const CallersBuffer copy(*caller_, vk::BufferUsageFlagBits::eTransferDst);
        image.signal_semaphore = handle_of(after);
        submit(fill, {}, *before);
        ASSERT_EQ(pt_readback_to_buffer(context(), &image), PT_OK) << pt_last_error(context());
        copy_to(copy, *after);
        ASSERT_TRUE(copy.bytes() == expected(image));
        image.signal_semaphore = 0;
        submit(fill, {}, *before);
        ASSERT_EQ(pt_readback_to_buffer(context(), &image), PT_OK) << pt_last_error(context());
        ASSERT_TRUE(buffer_->bytes() == expected(image)) << "the host has waited";
    }
}

// The validation layer reports memory that is freed too early.
TEST_F(ReadbackToBufferTest, TheContextMayChangeAndEndMeanwhile) {
    use_context(true);
    const vk::raii::Semaphore semaphores[] = {caller_->device().createSemaphore({}),
                                              caller_->device().createSemaphore({})};
    const pt_render smaller = render_of(5, 4, 3);
    for (const vk::raii::Semaphore &semaphore : semaphores) {
        pt_buffer_image image = target();
        image.signal_semaphore = handle_of(semaphore);
        EXPECT_EQ(pt_readback_to_buffer(context(), &image), PT_OK) << pt_last_error(context());
        EXPECT_EQ(pt_set_render(context(), &smaller), PT_OK) << pt_last_error(context());
        accumulate_on(context(), 40);
    }
    context_.reset();
    caller_->device().waitIdle();
}

TEST_F(ReadbackToBufferTest, NeitherWaitsNorTakesLaterSamples) {
    for (const bool like_gpus : {false, true}) {
        use_context(like_gpus);
        const BufferContents before = expected(target());
        const vk::raii::Semaphore after = caller_->device().createSemaphore({});
        pt_buffer_image image = target();
        image.signal_semaphore = handle_of(after);
        const pt_accumulate_info more = accumulate_info(40);
        {
            const HeldWork gate(caller_->device());
            submit([&](const vk::raii::CommandBuffer &commands) { gate.record(commands); }, {}, {});
            ASSERT_EQ(pt_readback_to_buffer(context(), &image), PT_OK) << pt_last_error(context());
            EXPECT_FALSE(buffer_->bytes() == before) << "it waited for the device";
            ASSERT_EQ(pt_start(context(), &more), PT_PENDING) << pt_last_error(context());
        }
        EXPECT_EQ(pt_poll(context(), UINT64_MAX, nullptr), PT_OK) << pt_last_error(context());
        caller_->device().waitIdle();
        EXPECT_TRUE(buffer_->bytes() == before);
        image.signal_semaphore = 0;
        EXPECT_EQ(pt_readback_to_buffer(context(), &image), PT_OK) << pt_last_error(context());
        EXPECT_TRUE(buffer_->bytes() == expected(target()));
        EXPECT_FALSE(buffer_->bytes() == before) << "more samples, another image";
    }
}

TEST_F(ReadbackToBufferTest, NeedsALentDeviceAndSamples) {
    auto info = sized<pt_create_info>();
    info.device = std::getenv("PT_TEST_DEVICE");
    pt_context *created = nullptr;
    ASSERT_EQ(pt_create(&info, &created), PT_OK) << pt_last_error(nullptr);
    context_.reset(created);
    refused(target(), PT_ERROR_INVALID_STATE,
            "the context does not use your Vulkan device: lend it one by pt_create_info.vulkan");
    use_context(false);
    const pt_render another = render_of(2, 2, 1);
    ASSERT_EQ(pt_set_render(context(), &another), PT_OK) << pt_last_error(context());
    refused(target(), PT_ERROR_INVALID_STATE, "no samples yet: call pt_accumulate or pt_add_film first");
}

TEST_F(ReadbackToBufferTest, RefusesWhatBreaksARule) {
    use_context(false);
    EXPECT_EQ(pt_readback_to_buffer(context(), nullptr), PT_ERROR_INVALID_ARGUMENT);
    pt_buffer_image image = target();
    image.size_bytes = 24'155;
    refused(image, PT_ERROR_INVALID_ARGUMENT,
            "image.size_bytes = 24155: must be >= (height - 1) * row_bytes + width * 12 (32 * 732 + 732)");
    image.struct_size = 0;
    refused(image, PT_ERROR_INVALID_ARGUMENT,
            "image.struct_size = 0: must be the size of the struct, which holds this field");
    EXPECT_TRUE(buffer_->bytes() == untouched_buffer()) << "nothing was written";
}

} // namespace
