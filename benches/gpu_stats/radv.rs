//! Mesa's AMD compiler on its null device: what it makes of formulas, with no GPU at hand.
//!
//! `RADV_FORCE_FAMILY` makes RADV pretend to be a chip; it compiles for it and reports statistics
//! through `VK_KHR_pipeline_executable_properties`. The variables are read when Vulkan is loaded,
//! so each family is a process of its own.

use ash::{Entry, khr, vk};
use lgp::emit::{Language, Snippet, emit};
use lgp::program::{Names, ParseError, Program, parse};
use std::error::Error;
use std::path::PathBuf;

/// Copies of a formula in one shader: one alone would measure memory.
pub const COPIES: usize = 24;

/// The inputs of every formula.
pub const INPUTS: [&str; 3] = ["a", "b", "c"];

/// The program of a formula of the inputs, for `y`.
pub fn program(formula: &str) -> Result<Program, ParseError> {
    parse(formula, &Names::new(INPUTS, ["y"]))
}

/// RADV's description of itself for the Vulkan loader, where a system has it.
pub fn driver() -> Option<PathBuf> {
    if let Some(path) = std::env::var_os("VK_ICD_FILENAMES") {
        return Some(path.into());
    }
    let folder = std::fs::read_dir("/usr/share/vulkan/icd.d").ok()?;
    let mut files: Vec<PathBuf> = folder.flatten().map(|entry| entry.path()).collect();
    files.sort();
    files.into_iter().find(|path| path.to_string_lossy().contains("radeon_icd"))
}

/// A shader with [`COPIES`] of a formula of [`INPUTS`], each on inputs of its own. The formulas' operations
/// are WGSL's own, so that the compiler sees what it would see of a snippet.
fn wgsl(program: &Program) -> String {
    let names = Names::new(INPUTS, ["result"]);
    let snippet = Snippet::new(program, &names, "formula");
    let function = emit(Language::Wgsl, &snippet);
    let calls: Vec<String> = (0..COPIES)
        .map(|i| format!("    let v{i} = source[at + {i}u]; target_[at + {i}u] = formula_result(v{i}.x, v{i}.y, v{i}.z);"))
        .collect();
    format!(
        "@group(0) @binding(0) var<storage, read> source: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> target_: array<f32>;
{function}
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {{
    let at = id.x*{COPIES}u;
{}
}}
",
        calls.join("\n")
    )
}

fn spirv(program: &Program) -> Result<Vec<u32>, Box<dyn Error>> {
    let module = naga::front::wgsl::parse_str(&wgsl(program))?;
    let flags = naga::valid::ValidationFlags::all();
    let info =
        naga::valid::Validator::new(flags, naga::valid::Capabilities::empty()).validate(&module)?;
    Ok(naga::back::spv::write_vec(&module, &info, &naga::back::spv::Options::default(), None)?)
}

/// A device that only compiles.
pub struct Compiler {
    // Vulkan is unloaded when this is dropped, so it stands until the end.
    _entry: Entry,
    device: ash::Device,
    properties: khr::pipeline_executable_properties::Device,
    layout: vk::PipelineLayout,
}

impl Compiler {
    /// The first device that Vulkan finds.
    pub fn new() -> Result<Compiler, Box<dyn Error>> {
        // SAFETY: Vulkan's objects are used on this thread only, and none is destroyed before the
        // process ends; every structure outlives the call that it is given to.
        unsafe {
            let entry = Entry::load()?;
            let application =
                vk::ApplicationInfo::default().api_version(vk::make_api_version(0, 1, 1, 0));
            let instance_info = vk::InstanceCreateInfo::default().application_info(&application);
            let instance = entry.create_instance(&instance_info, None)?;
            let physical = *instance.enumerate_physical_devices()?.first().ok_or(
                "Vulkan finds no device; is RADV_FORCE_FAMILY a chip that this Mesa knows?",
            )?;
            let mut features = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
                .pipeline_executable_info(true);
            let queues = [vk::DeviceQueueCreateInfo::default().queue_priorities(&[1.0])];
            let extensions = [khr::pipeline_executable_properties::NAME.as_ptr()];
            let device_info = vk::DeviceCreateInfo::default()
                .queue_create_infos(&queues)
                .enabled_extension_names(&extensions)
                .push_next(&mut features);
            let device = instance.create_device(physical, &device_info, None)?;
            let properties = khr::pipeline_executable_properties::Device::new(&instance, &device);
            let buffer = |binding| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(vk::DescriptorType::STORAGE_BUFFER)
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            };
            let bindings = [buffer(0), buffer(1)];
            let set_info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
            let sets = [device.create_descriptor_set_layout(&set_info, None)?];
            let layout_info = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets);
            let layout = device.create_pipeline_layout(&layout_info, None)?;
            Ok(Compiler { _entry: entry, device, properties, layout })
        }
    }

    /// The statistics of a formula's shader, by the names that the driver gives them.
    pub fn statistics(&self, program: &Program) -> Result<Vec<(String, f64)>, Box<dyn Error>> {
        let code = spirv(program)?;
        // SAFETY: as in `new`; the shader was validated, and which member of a value is set is told by
        // its format.
        unsafe {
            let module_info = vk::ShaderModuleCreateInfo::default().code(&code);
            let module = self.device.create_shader_module(&module_info, None)?;
            let stage = vk::PipelineShaderStageCreateInfo::default()
                .stage(vk::ShaderStageFlags::COMPUTE)
                .module(module)
                .name(c"main");
            let info = vk::ComputePipelineCreateInfo::default()
                .flags(vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR)
                .stage(stage)
                .layout(self.layout);
            let pipelines = self
                .device
                .create_compute_pipelines(vk::PipelineCache::null(), &[info], None)
                .map_err(|(_, error)| error)?;
            let executable = vk::PipelineExecutableInfoKHR::default().pipeline(pipelines[0]);
            let statistics = self.properties.get_pipeline_executable_statistics(&executable)?;
            let number = |statistic: &vk::PipelineExecutableStatisticKHR| match statistic.format {
                vk::PipelineExecutableStatisticFormatKHR::UINT64 => statistic.value.u64 as f64,
                vk::PipelineExecutableStatisticFormatKHR::INT64 => statistic.value.i64 as f64,
                vk::PipelineExecutableStatisticFormatKHR::FLOAT64 => statistic.value.f64,
                _ => f64::from(statistic.value.b32),
            };
            let named = statistics.iter().map(|statistic| {
                let name = statistic.name_as_c_str()?.to_string_lossy().into_owned();
                Ok((name, number(statistic)))
            });
            let named = named.collect::<Result<_, Box<dyn Error>>>();
            self.device.destroy_pipeline(pipelines[0], None);
            self.device.destroy_shader_module(module, None);
            named
        }
    }

    /// Inverse throughput of one copy, in cycles of the chip.
    pub fn cycles(&self, program: &Program) -> Result<f64, Box<dyn Error>> {
        let statistics = self.statistics(program)?;
        let found = statistics.iter().find(|(name, _)| name == "Inverse Throughput");
        let (_, cycles) = found.ok_or("this Mesa reports no inverse throughput")?;
        Ok(cycles / COPIES as f64)
    }
    /// What a step of Horner's scheme takes, which is a multiply-add: chips and Mesa's versions
    /// count in different clocks.
    pub fn cycles_of_a_step(&self) -> Result<f64, Box<dyn Error>> {
        let horner = |steps: usize| {
            let step = |i: usize| format!("t{} = t{i}*b + c; ", i + 1);
            let steps: String = (0..steps).map(step).collect::<String>() + &format!("y = t{steps}");
            self.cycles(&program(&format!("t0 = a; {steps}"))?)
        };
        Ok((horner(30)? - horner(10)?) / 20.0)
    }
}
