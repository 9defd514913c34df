//! The same filter in Rust: `rustc -O --crate-type cdylib leaky_mean.rs -o rust_mean.so`
use std::ffi::{c_char, c_void};

#[repr(C)]
pub struct Parameter { name: *const c_char, unit: *const c_char, meaning: *const c_char, from: f64, to: f64, value: f64, range: u32 }
#[repr(C)]
pub struct Sample { t_s: f64, gyro_dps: f64, temperature_c: f64, heading_deg: f64, true_rate_dps: f64, true_drift_dps: f64 }
#[repr(C)]
pub struct Step { estimate_dps: f64, estimate_variance: f64, innovation_dps: f64, innovation_variance: f64, status: f64 }
#[repr(C)]
pub struct Filter {
    name: *const c_char, title: *const c_char, corrects: u32, needs: u32,
    parameter_count: u32, parameters: *const Parameter,
    create: extern "C" fn(*const f64) -> *mut c_void,
    step: extern "C" fn(*mut c_void, *const Sample, *mut Step, usize),
    destroy: extern "C" fn(*mut c_void),
}
#[repr(C)]
pub struct Plugin { abi: u32, filter_count: u32, effect_count: u32, filters: *const Filter, effects: *const c_void }
unsafe impl Sync for Parameter {}
unsafe impl Sync for Filter {}
unsafe impl Sync for Plugin {}

struct LeakyMean { gain: f64, mean: f64 }

impl LeakyMean {
    fn step(&mut self, sample: &Sample, step: &mut Step) {
        let innovation = sample.gyro_dps - self.mean;
        if innovation.is_nan() {
            step.status = 1.0; // GYROSTAT_NO_MEASUREMENT
        } else {
            self.mean += self.gain * innovation;
            step.innovation_dps = innovation;
        }
        step.estimate_dps = self.mean;
    }
}

extern "C" fn create(values: *const f64) -> *mut c_void {
    let time_constant = unsafe { *values };
    Box::into_raw(Box::new(LeakyMean { gain: 1.0 / time_constant, mean: 0.0 })).cast()
}

extern "C" fn step(filter: *mut c_void, samples: *const Sample, steps: *mut Step, count: usize) {
    let filter = unsafe { &mut *filter.cast::<LeakyMean>() };
    let samples = unsafe { std::slice::from_raw_parts(samples, count) };
    let steps = unsafe { std::slice::from_raw_parts_mut(steps, count) };
    samples.iter().zip(steps).for_each(|(sample, step)| filter.step(sample, step));
}

extern "C" fn destroy(filter: *mut c_void) {
    drop(unsafe { Box::from_raw(filter.cast::<LeakyMean>()) });
}

const fn text(bytes: &'static [u8]) -> *const c_char { bytes.as_ptr() as *const c_char }

static PARAMETERS: [Parameter; 1] = [Parameter {
    name: text(b"time_constant\0"), unit: text(b"samples\0"), meaning: text(b"memory of the mean\0"),
    from: 1.0, to: f64::INFINITY, value: 50.0, range: 0,
}];
static FILTER: Filter = Filter {
    name: text(b"rust_mean\0"), title: text(b"leaky mean, in Rust\0"), corrects: 0, needs: 0,
    parameter_count: 1, parameters: PARAMETERS.as_ptr(), create, step, destroy,
};
static PLUGIN: Plugin = Plugin { abi: 1, filter_count: 1, effect_count: 0, filters: &FILTER, effects: std::ptr::null() };

#[no_mangle]
pub extern "C" fn gyrostat_describe() -> *const Plugin { &PLUGIN }
