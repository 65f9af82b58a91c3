// SPDX-License-Identifier: Apache-2.0
#ifndef TETRALIGHT_C_API_CONSUMER_H
#define TETRALIGHT_C_API_CONSUMER_H

#ifdef __cplusplus
extern "C" {
#endif

/* 0, or the number of the step that failed. */
int run_c_api_consumer(const char* path);

#ifdef __cplusplus
}
#endif

#endif
