//! Runs compute shaders on a Vulkan device, from one buffer to another.
//!
//! The loader is found when a program runs: without one, [`Gpu::open`] says so.

// Tests and examples share this, and each uses a part of it.
#![allow(dead_code)]

use ash::vk;

/// A device and a queue of it.
pub struct Gpu {
    /// What the driver calls it.
    pub name: String,
    /// Whether shaders may compute in half precision.
    pub half: bool,
    instance: ash::Instance,
    device: ash::Device,
    queue: vk::Queue,
    family: u32,
    memory: vk::PhysicalDeviceMemoryProperties,
    /// Nanoseconds.
    tick: f64,
    /// The loader: to be dropped last.
    _entry: ash::Entry,
}

/// What a shader left behind.
pub struct Ran {
    pub output: Vec<f32>,
    /// Between the device's time stamps before and after.
    pub seconds: f64,
}

/// A buffer that the host can write and read.
struct Buffer {
    handle: vk::Buffer,
    memory: vk::DeviceMemory,
    floats: usize,
}

type Outcome<T> = Result<T, String>;

fn failed(what: &str) -> impl Fn(vk::Result) -> String + '_ {
    move |error| format!("{what}: {error}")
}

impl Gpu {
    /// The first device whose name has `wanted` in it, in upper or lower case.
    ///
    /// # Errors
    /// What is missing: the loader, a driver, such a device.
    pub fn open(wanted: &str) -> Outcome<Gpu> {
        // SAFETY: the loader is a library made to be loaded so, and lives as long as what it made.
        let entry = unsafe { ash::Entry::load() }.map_err(|e| format!("no Vulkan loader: {e}"))?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_2);
        let create = vk::InstanceCreateInfo::default().application_info(&application);
        // SAFETY: the structures live until the call returns, as in each call below.
        let instance = unsafe { entry.create_instance(&create, None) }
            .map_err(failed("no Vulkan instance"))?;
        // SAFETY: `instance` is alive.
        let found = unsafe { instance.enumerate_physical_devices() };
        let mut names = Vec::new();
        for physical in found.map_err(failed("no Vulkan devices"))? {
            // SAFETY: `physical` is a device of `instance`.
            let properties = unsafe { instance.get_physical_device_properties(physical) };
            let name = properties.device_name_as_c_str().map(|name| name.to_string_lossy());
            let name = name.unwrap_or_default().into_owned();
            if name.to_lowercase().contains(&wanted.to_lowercase()) {
                return Gpu::of(entry, instance, physical, name, properties.limits);
            }
            names.push(name);
        }
        Err(format!("no Vulkan device is called `{wanted}` (there are: {})", names.join(", ")))
    }

    fn of(
        entry: ash::Entry,
        instance: ash::Instance,
        physical: vk::PhysicalDevice,
        name: String,
        limits: vk::PhysicalDeviceLimits,
    ) -> Outcome<Gpu> {
        // SAFETY: `physical` is a device of `instance`.
        let families = unsafe { instance.get_physical_device_queue_family_properties(physical) };
        let computes =
            |f: &vk::QueueFamilyProperties| f.queue_flags.contains(vk::QueueFlags::COMPUTE);
        let family = families.iter().position(computes);
        let family = family.ok_or_else(|| format!("{name} computes nothing"))? as u32;
        let mut known = vk::PhysicalDeviceVulkan12Features::default();
        let mut all = vk::PhysicalDeviceFeatures2::default().push_next(&mut known);
        // SAFETY: as above; the chain holds structures of Vulkan 1.2, which the instance is of.
        unsafe { instance.get_physical_device_features2(physical, &mut all) };
        let half = known.shader_float16 == vk::TRUE;
        let mut wanted = vk::PhysicalDeviceVulkan12Features::default().shader_float16(half);
        let queues = [vk::DeviceQueueCreateInfo::default()
            .queue_family_index(family)
            .queue_priorities(&[1.0])];
        let create =
            vk::DeviceCreateInfo::default().queue_create_infos(&queues).push_next(&mut wanted);
        // SAFETY: the features asked for are features it has.
        let device = unsafe { instance.create_device(physical, &create, None) };
        let device = device.map_err(failed("no Vulkan device"))?;
        // SAFETY: the family has the one queue that was asked for.
        let queue = unsafe { device.get_device_queue(family, 0) };
        // SAFETY: `physical` is a device of `instance`.
        let memory = unsafe { instance.get_physical_device_memory_properties(physical) };
        let tick = f64::from(limits.timestamp_period);
        Ok(Gpu { name, half, instance, device, queue, family, memory, tick, _entry: entry })
    }

    /// Runs `main` of the module in `groups` work groups. Its binding 0 holds `input`, its
    /// binding 1 room for `outputs` floats.
    ///
    /// # Errors
    /// What Vulkan refused.
    pub fn run(&self, spirv: &[u32], input: &[f32], outputs: usize, groups: u32) -> Outcome<Ran> {
        let source = self.buffer(input.len())?;
        self.write(&source, input)?;
        let target = self.buffer(outputs)?;
        self.write(&target, &vec![f32::NAN; outputs])?;
        let seconds = self.dispatch(spirv, [&source, &target], groups)?;
        let output = self.read(&target)?;
        for buffer in [source, target] {
            // SAFETY: the queue is idle, so nothing uses the buffer any more.
            unsafe {
                self.device.destroy_buffer(buffer.handle, None);
                self.device.free_memory(buffer.memory, None);
            }
        }
        Ok(Ran { output, seconds })
    }

    fn buffer(&self, floats: usize) -> Outcome<Buffer> {
        let create = vk::BufferCreateInfo::default()
            .size((floats * size_of::<f32>()) as u64)
            .usage(vk::BufferUsageFlags::STORAGE_BUFFER);
        // SAFETY: `device` is alive, as in each call below.
        let handle = unsafe { self.device.create_buffer(&create, None) };
        let handle = handle.map_err(failed("no buffer"))?;
        // SAFETY: `handle` is a buffer of `device`.
        let needs = unsafe { self.device.get_buffer_memory_requirements(handle) };
        let wanted = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        let kind = self.memory.memory_types_as_slice().iter().enumerate().position(|(i, kind)| {
            needs.memory_type_bits >> i & 1 == 1 && kind.property_flags.contains(wanted)
        });
        let kind = kind.ok_or("no memory that the host can see")? as u32;
        let allocate =
            vk::MemoryAllocateInfo::default().allocation_size(needs.size).memory_type_index(kind);
        // SAFETY: the memory is as large and of a type as the buffer needs, and bound once.
        unsafe {
            let memory =
                self.device.allocate_memory(&allocate, None).map_err(failed("no memory"))?;
            self.device.bind_buffer_memory(handle, memory, 0).map_err(failed("no memory"))?;
            Ok(Buffer { handle, memory, floats })
        }
    }

    fn write(&self, buffer: &Buffer, values: &[f32]) -> Outcome<()> {
        let all = vk::MemoryMapFlags::empty();
        // SAFETY: the memory is visible to the host, holds `floats` floats, and nothing runs.
        unsafe {
            let to = self.device.map_memory(buffer.memory, 0, vk::WHOLE_SIZE, all);
            let to = to.map_err(failed("not mapped"))?.cast::<f32>();
            to.copy_from_nonoverlapping(values.as_ptr(), values.len().min(buffer.floats));
            self.device.unmap_memory(buffer.memory);
        }
        Ok(())
    }

    fn read(&self, buffer: &Buffer) -> Outcome<Vec<f32>> {
        let mut values = vec![0.0f32; buffer.floats];
        let all = vk::MemoryMapFlags::empty();
        // SAFETY: as in `write`.
        unsafe {
            let from = self.device.map_memory(buffer.memory, 0, vk::WHOLE_SIZE, all);
            let from = from.map_err(failed("not mapped"))?.cast::<f32>();
            values.as_mut_ptr().copy_from_nonoverlapping(from, buffer.floats);
            self.device.unmap_memory(buffer.memory);
        }
        Ok(values)
    }

    /// Gives the seconds between the time stamps around the dispatch, which has then ended.
    fn dispatch(&self, spirv: &[u32], buffers: [&Buffer; 2], groups: u32) -> Outcome<f64> {
        let device = &self.device;
        let bindings = [0, 1].map(|binding| {
            vk::DescriptorSetLayoutBinding::default()
                .binding(binding)
                .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                .descriptor_count(1)
                .stage_flags(vk::ShaderStageFlags::COMPUTE)
        });
        let layout = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        let sizes = [vk::DescriptorPoolSize::default()
            .ty(vk::DescriptorType::STORAGE_BUFFER)
            .descriptor_count(2)];
        let pool = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        let module = vk::ShaderModuleCreateInfo::default().code(spirv);
        let commands = vk::CommandPoolCreateInfo::default().queue_family_index(self.family);
        let stamps =
            vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::TIMESTAMP).query_count(2);
        // SAFETY: every handle is of `device`, outlives what is made of it, and is destroyed
        // once, when the queue is idle; the module was validated by the compiler that made it.
        unsafe {
            let layouts =
                [device.create_descriptor_set_layout(&layout, None).map_err(failed("layout"))?];
            let pool = device.create_descriptor_pool(&pool, None).map_err(failed("pool"))?;
            let allocate = vk::DescriptorSetAllocateInfo::default()
                .descriptor_pool(pool)
                .set_layouts(&layouts);
            let sets = device.allocate_descriptor_sets(&allocate).map_err(failed("set"))?;
            for (binding, buffer) in (0..).zip(buffers) {
                let whole = [vk::DescriptorBufferInfo::default()
                    .buffer(buffer.handle)
                    .range(vk::WHOLE_SIZE)];
                let write = vk::WriteDescriptorSet::default()
                    .dst_set(sets[0])
                    .dst_binding(binding)
                    .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                    .buffer_info(&whole);
                device.update_descriptor_sets(&[write], &[]);
            }
            let create = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts);
            let layout = device.create_pipeline_layout(&create, None).map_err(failed("layout"))?;
            let module = device.create_shader_module(&module, None).map_err(failed("module"))?;
            let stage = vk::PipelineShaderStageCreateInfo::default()
                .stage(vk::ShaderStageFlags::COMPUTE)
                .module(module)
                .name(c"main");
            let create = vk::ComputePipelineCreateInfo::default().stage(stage).layout(layout);
            let cache = vk::PipelineCache::null();
            let pipelines = device
                .create_compute_pipelines(cache, &[create], None)
                .map_err(|(_, error)| format!("the shader was not compiled: {error}"))?;
            let commands = device.create_command_pool(&commands, None).map_err(failed("pool"))?;
            let stamps = device.create_query_pool(&stamps, None).map_err(failed("stamps"))?;
            let allocate = vk::CommandBufferAllocateInfo::default()
                .command_pool(commands)
                .command_buffer_count(1);
            let recorded =
                device.allocate_command_buffers(&allocate).map_err(failed("commands"))?;
            let buffer = recorded[0];
            let begin = vk::CommandBufferBeginInfo::default();
            device.begin_command_buffer(buffer, &begin).map_err(failed("commands"))?;
            device.cmd_reset_query_pool(buffer, stamps, 0, 2);
            device.cmd_bind_pipeline(buffer, vk::PipelineBindPoint::COMPUTE, pipelines[0]);
            let bind = vk::PipelineBindPoint::COMPUTE;
            device.cmd_bind_descriptor_sets(buffer, bind, layout, 0, &sets, &[]);
            device.cmd_write_timestamp(buffer, vk::PipelineStageFlags::TOP_OF_PIPE, stamps, 0);
            device.cmd_dispatch(buffer, groups, 1, 1);
            device.cmd_write_timestamp(buffer, vk::PipelineStageFlags::BOTTOM_OF_PIPE, stamps, 1);
            device.end_command_buffer(buffer).map_err(failed("commands"))?;
            let submit = [vk::SubmitInfo::default().command_buffers(&recorded)];
            let no_fence = vk::Fence::null();
            device.queue_submit(self.queue, &submit, no_fence).map_err(failed("not run"))?;
            device.queue_wait_idle(self.queue).map_err(failed("not ended"))?;
            let mut ticks = [0u64; 2];
            let flags = vk::QueryResultFlags::TYPE_64 | vk::QueryResultFlags::WAIT;
            device
                .get_query_pool_results(stamps, 0, &mut ticks, flags)
                .map_err(failed("stamps"))?;
            device.destroy_query_pool(stamps, None);
            device.destroy_command_pool(commands, None);
            device.destroy_pipeline(pipelines[0], None);
            device.destroy_shader_module(module, None);
            device.destroy_pipeline_layout(layout, None);
            device.destroy_descriptor_pool(pool, None);
            device.destroy_descriptor_set_layout(layouts[0], None);
            Ok(ticks[1].wrapping_sub(ticks[0]) as f64 * self.tick * 1e-9)
        }
    }
}

impl Drop for Gpu {
    fn drop(&mut self) {
        // SAFETY: nothing made of them is left: every run destroys what it made.
        unsafe {
            self.device.destroy_device(None);
            self.instance.destroy_instance(None);
        }
    }
}
