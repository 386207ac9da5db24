#include "core/io/gltf_accessors.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/base/check.h"

namespace fluxwalk::io {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are read in place");

/// Elements that an accessor without data may have beyond one for each byte of the file's buffers.
constexpr std::uint64_t kFreeZeros = 65536;

template <class T>
T load(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

// 0 for types that glTF does not have.
std::size_t bytesOfType(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

unsigned componentsOf(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        default:
            return 0;
    }
}

std::uint32_t loadIndex(const std::uint8_t* bytes, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<std::uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

bool isIndexType(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// Bytes of `count` elements from `offset` of a view, where they fit.
std::span<const std::uint8_t> elementsOf(const GltfModel& model, int bufferView, std::uint64_t offset,
                                         std::uint64_t stride, std::uint64_t elementBytes,
                                         std::uint64_t count, const std::string& place) {
    const std::span<const std::uint8_t> view = model.view(bufferView, place);
    // All factors are below 2^32 (validateGltf), so nothing overflows.
    const std::uint64_t end = offset + stride * (count - 1) + elementBytes;
    if (end > view.size()) {
        model.fail(place, std::to_string(count) + " elements end at byte " + std::to_string(end) +
                              " of a buffer view that has " + std::to_string(view.size()));
    }
    return view.subspan(static_cast<std::size_t>(offset));
}

}  // namespace

AccessorReader::AccessorReader(const GltfModel& model, int accessor)
    : place_("/accessors/" + std::to_string(accessor)) {
    const tinygltf::Accessor& a = model.at(model.data.accessors, accessor, place_);
    count_ = a.count;
    components_ = componentsOf(a.type);
    type_ = a.componentType;
    normalized_ = a.normalized;
    if (components_ == 0) {
        model.fail(place_ + "/type", "matrices are not vertex data");
    }
    if (bytesOfType(type_) == 0) {
        model.fail(place_ + "/componentType", std::to_string(type_) + " is not a component type of glTF");
    }
    if (count_ == 0) {
        model.fail(place_ + "/count", "is zero");
    }
    elementBytes_ = bytesOfType(type_) * components_;
    stride_ = elementBytes_;
    if (a.bufferView >= 0) {
        const tinygltf::BufferView& view = model.at(model.data.bufferViews, a.bufferView, place_);
        if (view.byteStride != 0) {
            stride_ = view.byteStride;
        }
        if (stride_ < elementBytes_) {
            model.fail(place_, "elements of " + std::to_string(elementBytes_) +
                                   " bytes overlap: the buffer view's byteStride is " +
                                   std::to_string(stride_));
        }
        data_ = elementsOf(model, a.bufferView, a.byteOffset, stride_, elementBytes_, count_, place_);
    } else {
        std::uint64_t allowed = kFreeZeros;
        for (const tinygltf::Buffer& buffer : model.data.buffers) {
            allowed += buffer.data.size();
        }
        if (count_ > allowed) {
            model.fail(place_ + "/count",
                       std::to_string(count_) + " elements without data, in a file that holds far less");
        }
    }
    if (a.sparse.isSparse) {
        readSparse(model, a);
    }
}

void AccessorReader::readSparse(const GltfModel& model, const tinygltf::Accessor& accessor) {
    const std::string place = place_ + "/sparse";
    const auto& sparse = accessor.sparse;
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > count_) {
        model.fail(place + "/count", std::to_string(sparse.count) + " is not from 1 to the accessor's count");
    }
    if (!isIndexType(sparse.indices.componentType)) {
        model.fail(place + "/indices/componentType", "is not an unsigned integer type");
    }
    const auto count = static_cast<std::size_t>(sparse.count);
    const std::size_t indexBytes = bytesOfType(sparse.indices.componentType);
    const std::span<const std::uint8_t> indices =
        elementsOf(model, sparse.indices.bufferView, static_cast<std::uint64_t>(sparse.indices.byteOffset),
                   indexBytes, indexBytes, count, place + "/indices");
    sparseValues_ =
        elementsOf(model, sparse.values.bufferView, static_cast<std::uint64_t>(sparse.values.byteOffset),
                   elementBytes_, elementBytes_, count, place + "/values");
    sparseIndices_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t index = loadIndex(indices.data() + i * indexBytes, sparse.indices.componentType);
        if (index >= count_ || (i > 0 && index <= sparseIndices_.back())) {
            model.fail(place + "/indices", "index " + std::to_string(index) + " is out of range or order");
        }
        sparseIndices_.push_back(index);
    }
}

bool AccessorReader::isInteger() const {
    return isIndexType(type_) && components_ == 1 && !normalized_;
}

const std::uint8_t* AccessorReader::bytesOf(std::size_t element) const {
    FLUXWALK_CHECK_LT(element, count_);
    if (!sparseIndices_.empty()) {
        const auto found = std::lower_bound(sparseIndices_.begin(), sparseIndices_.end(), element);
        if (found != sparseIndices_.end() && *found == element) {
            return sparseValues_.data() +
                   static_cast<std::size_t>(found - sparseIndices_.begin()) * elementBytes_;
        }
    }
    return data_.empty() ? nullptr : data_.data() + element * stride_;
}

double AccessorReader::component(std::size_t element, unsigned component) const {
    FLUXWALK_CHECK_LT(component, components_);
    const std::uint8_t* bytes = bytesOf(element);
    if (bytes == nullptr) {
        return 0.0;
    }
    bytes += component * bytesOfType(type_);
    const auto scaled = [this](double value, double most) {
        return normalized_ ? std::max(value / most, -1.0) : value;
    };
    switch (type_) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return scaled(load<std::int8_t>(bytes), 127.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return scaled(load<std::uint8_t>(bytes), 255.0);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return scaled(load<std::int16_t>(bytes), 32767.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return scaled(load<std::uint16_t>(bytes), 65535.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return scaled(load<std::uint32_t>(bytes), 4294967295.0);
        default:
            return static_cast<double>(load<float>(bytes));
    }
}

std::uint32_t AccessorReader::index(std::size_t element) const {
    const std::uint8_t* bytes = bytesOf(element);
    return bytes == nullptr ? 0 : loadIndex(bytes, type_);
}

}  // namespace fluxwalk::io
