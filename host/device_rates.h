// What a Vulkan device can do at most, measured: the yardstick of the benchmark.
#pragma once

#include "engine/pipeline/backend.h"
#include "host/device.h"

namespace quorum {

/// Rates over the whole device: 32-bit multiplications and additions in registers, and the bytes that a copy between
/// two buffers reads and writes. Takes under a second and 128 MiB on the device. Fails (kDevice, kMemory) if the device
/// does.
Expected<DeviceRates> measure_device_rates(const Device& device);

}  // namespace quorum
