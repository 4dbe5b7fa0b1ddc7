/work/main/tests/end_to_end/zz_tmp.cpp.o: \
 /work/main/tests/end_to_end/zz_tmp.cpp /usr/include/stdc-predef.h \
 /work/main/framework/app/session.h /work/main/framework/graph/renderer.h \
 /work/main/framework/graph/runner.h /work/main/framework/gpu/commands.h \
 /work/main/framework/gpu/buffer.h /work/main/framework/gpu/device.h \
 /work/main/framework/core/api.h /usr/include/vulkan/vulkan.h \
 /usr/include/vulkan/vk_platform.h \
 /usr/lib/gcc/x86_64-linux-gnu/12/include/stddef.h \
 /usr/lib/gcc/x86_64-linux-gnu/12/include/stdint.h \
 /usr/include/vulkan/vulkan_core.h \
 /usr/include/vk_video/vulkan_video_codec_h264std.h \
 /usr/include/vk_video/vulkan_video_codec_h264std_decode.h \
 /usr/include/vk_video/vulkan_video_codec_h265std.h \
 /usr/include/vk_video/vulkan_video_codec_h265std_decode.h \
 /work/main/build/deps/include/vk_mem_alloc.h /usr/include/c++/12/cstddef \
 /usr/include/c++/12/cstdint /usr/include/c++/12/memory \
 /usr/include/c++/12/mutex /usr/include/c++/12/optional \
 /usr/include/c++/12/string /usr/include/c++/12/vector \
 /usr/include/c++/12/span /work/main/framework/gpu/pipeline.h \
 /work/main/framework/gpu/shader.h /work/main/framework/core/files.h \
 /usr/include/c++/12/filesystem /usr/include/c++/12/functional \
 /usr/include/c++/12/string_view /usr/include/c++/12/map \
 /work/main/framework/graph/graph.h \
 /work/main/framework/graph/description.h \
 /work/main/framework/core/json.h /work/main/framework/core/error.h \
 /usr/include/c++/12/exception /usr/include/nlohmann/json_fwd.hpp \
 /usr/include/c++/12/utility /work/main/framework/pass/pass.h \
 /work/main/framework/pass/bundle.h /work/main/framework/pass/port.h \
 /work/main/framework/shaders/base/shared.h /usr/include/c++/12/array \
 /usr/include/c++/12/concepts /usr/include/c++/12/deque \
 /usr/include/c++/12/bits/stl_algobase.h \
 /usr/include/c++/12/bits/allocator.h \
 /usr/include/c++/12/bits/stl_construct.h \
 /usr/include/c++/12/bits/stl_uninitialized.h \
 /usr/include/c++/12/bits/stl_deque.h \
 /usr/include/c++/12/bits/concept_check.h \
 /usr/include/c++/12/bits/stl_iterator_base_types.h \
 /usr/include/c++/12/bits/stl_iterator_base_funcs.h \
 /usr/include/c++/12/initializer_list /usr/include/c++/12/compare \
 /usr/include/c++/12/debug/assertions.h \
 /usr/include/c++/12/bits/refwrap.h \
 /usr/include/c++/12/bits/range_access.h \
 /usr/include/c++/12/bits/deque.tcc /work/main/framework/pass/parameter.h \
 /usr/include/c++/12/type_traits /usr/include/c++/12/variant \
 /work/main/framework/shaders/world/ray.h \
 /work/main/framework/shaders/base/shared.h \
 /work/main/framework/shaders/world/world.h /usr/include/c++/12/cstring \
 /usr/include/x86_64-linux-gnu/c++/12/bits/c++config.h \
 /usr/include/string.h /work/main/framework/graph/plugins.h \
 /work/main/framework/graph/plan.h /work/main/framework/graph/probe.h \
 /work/main/framework/shaders/base/probe.h \
 /work/main/framework/graph/ray_body.h /work/main/framework/image/image.h \
 /usr/include/c++/12/cassert /usr/include/assert.h \
 /usr/include/features.h /work/main/framework/shaders/base/frame.h \
 /work/main/framework/scene/scene.h
