// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/hash/sha256.h>

#include <openssl/evp.h>

#include <new>

#include <tetralight/base/contract.h>
#include <tetralight/base/hex.h>

namespace tetralight {
namespace {

/// OpenSSL fails here only without memory or without SHA-256 itself.
EVP_MD_CTX* new_context() {
    EVP_MD_CTX* context = EVP_MD_CTX_new();
    if (context == nullptr) throw std::bad_alloc();
    return context;
}

}  // namespace

void Sha256::Free::operator()(evp_md_ctx_st* context) const noexcept {
    EVP_MD_CTX_free(context);
}

Sha256::Sha256() : context_(new_context()) {
    [[maybe_unused]] const bool is_ready =
        EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1;
    TETRALIGHT_ASSERT(is_ready, "OpenSSL without SHA-256");
}

void Sha256::add(std::span<const std::byte> bytes) {
    [[maybe_unused]] const bool is_added =
        EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1;
    TETRALIGHT_ASSERT(is_added, "OpenSSL cannot hash");
}

Sha256Digest Sha256::digest() const {
    // Reading the hash ends a context, so a copy is read.
    const std::unique_ptr<EVP_MD_CTX, Free> copy(new_context());
    Sha256Digest digest{};
    [[maybe_unused]] const bool is_read =
        EVP_MD_CTX_copy_ex(copy.get(), context_.get()) == 1 &&
        EVP_DigestFinal_ex(copy.get(), reinterpret_cast<unsigned char*>(digest.data()), nullptr) ==
            1;
    TETRALIGHT_ASSERT(is_read, "OpenSSL cannot hash");
    return digest;
}

std::string Sha256::hex() const {
    return tetralight::hex(digest());
}

std::string sha256_hex(std::span<const std::byte> bytes) {
    Sha256 hash;
    hash.add(bytes);
    return hash.hex();
}

}  // namespace tetralight
